// An emulated machine over time: faults at their times, and a record of the true state.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

#include "hal/clock.h"
#include "hal/simulated/clock.h"
#include "host_tools/emulators/emulated_machine.h"
#include "host_tools/emulators/fault_plan.h"

namespace tactus::host {

// The planned events of a run, and the recording.
struct EmulatedRunConfig {
  std::vector<PlannedFault> faults;
  // The period of the recorded truth; 0: nothing is recorded.
  hal::TimeNs truth_period_ns = 0;
  // The time for which memory is reserved, so that a run in real time does not allocate.
  double expected_s = 60.0;
};

// A run. One thread.
class EmulatedRun {
 public:
  // A run that is later than this leaves the time out instead of catching up.
  static constexpr hal::TimeNs kLongestDelay_ns = 50'000'000;
  // The longest time between two calls of a device that listens.
  static constexpr hal::TimeNs kListeningPeriod_ns = 1'000'000;

  // The machine must have its axes connected and must outlive the run. Throws InputError if a fault
  // names a joint that the machine has not.
  EmulatedRun(EmulatedMachine& machine, EmulatedRunConfig config);

  // Makes every step that begins by `now_ns`, each after the faults that are due by then. Devices
  // that listen are run in the last of them, when something may have arrived, and once in
  // kListeningPeriod_ns. `due_ns` is the time for which this call was meant; without it, that of
  // the next step.
  void run(hal::TimeNs now_ns, hal::TimeNs due_ns);
  void run(hal::TimeNs now_ns) { run(now_ns, next_step_ns()); }

  [[nodiscard]] hal::TimeNs next_step_ns() const { return machine_.next_step_ns(); }
  // Returns the machine, for reports.
  [[nodiscard]] const EmulatedMachine& machine() const { return machine_; }
  // Returns the recorded states.
  [[nodiscard]] std::span<const MachineTruth> truth() const { return truth_; }

  // Returns the largest delay of a call of run(), and the time that was left out because a delay
  // was longer than kLongestDelay_ns.
  [[nodiscard]] hal::TimeNs longest_delay_ns() const { return longest_delay_ns_; }
  [[nodiscard]] hal::TimeNs left_out_ns() const { return left_out_ns_; }

 private:
  // Sets the faults that are due at the next step.
  void apply_faults();
  // Makes the next step. `is_last` says that nothing but what arrives now can have arrived in it.
  void make_step(bool is_last);
  // Records the state if its period is over.
  void keep_truth();

  EmulatedMachine& machine_;
  EmulatedRunConfig config_;
  std::size_t next_fault_ = 0;
  hal::TimeNs next_truth_ns_;
  // When devices that listen are run next even if nothing arrives.
  hal::TimeNs next_listening_ns_;
  std::vector<MachineTruth> truth_;
  hal::TimeNs longest_delay_ns_ = 0;
  hal::TimeNs left_out_ns_ = 0;
};

// Lets a run advance whenever simulated time passes. Run and clock must outlive it.
class ClockedRun final : private hal::SimulatedEventSource {
 public:
  ClockedRun(EmulatedRun& run, hal::SimulatedClock& clock);
  ClockedRun(const ClockedRun&) = delete;
  ClockedRun& operator=(const ClockedRun&) = delete;
  ~ClockedRun();

 private:
  hal::TimeNs next_event_ns() const override { return run_.next_step_ns(); }
  void run_event() override { run_.run(clock_.now_ns()); }

  EmulatedRun& run_;
  hal::SimulatedClock& clock_;
};

// Writes one line a state, with the columns of README.md. Throws InputError if the file cannot be
// written.
void write_truth(const std::filesystem::path& path, std::span<const MachineTruth> truth,
                 std::size_t joints);

}  // namespace tactus::host
