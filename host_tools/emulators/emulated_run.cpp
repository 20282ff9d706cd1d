#include "host_tools/emulators/emulated_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "host_tools/input_error.h"

namespace tactus::host {

EmulatedRun::EmulatedRun(EmulatedMachine& machine, EmulatedRunConfig config)
    : machine_(machine),
      config_(std::move(config)),
      next_truth_ns_(machine.next_step_ns()),
      next_listening_ns_(machine.next_step_ns()) {
  for (const PlannedFault& planned : config_.faults) {
    if (planned.joint && *planned.joint >= machine_.joints()) {
      throw InputError(fmt::format("a fault of axis {}: this device has the axes 0 to {}",
                                   *planned.joint, machine_.joints() - 1));
    }
  }
  // An insertion sort by time: faults of one instant keep the order in which they were given.
  for (auto next = config_.faults.begin(); next != config_.faults.end(); ++next) {
    const auto place =
        std::upper_bound(config_.faults.begin(), next, *next,
                         [](const auto& a, const auto& b) { return a.at_s < b.at_s; });
    std::rotate(place, next, next + 1);
  }
  if (config_.truth_period_ns > 0) {
    const double samples = 1e9 * config_.expected_s / static_cast<double>(config_.truth_period_ns);
    truth_.reserve(static_cast<std::size_t>(samples) + 1000);
  }
}

void EmulatedRun::run(hal::TimeNs now_ns, hal::TimeNs due_ns) {
  const hal::TimeNs delay_ns = now_ns - due_ns;
  longest_delay_ns_ = std::max(longest_delay_ns_, delay_ns);
  if (delay_ns > kLongestDelay_ns) {
    machine_.skip_to(now_ns);
    left_out_ns_ += delay_ns;
  }
  while (machine_.next_step_ns() <= now_ns) {
    apply_faults();
    make_step(machine_.next_step_ns() + machine_.step_ns() > now_ns);
    keep_truth();
  }
}

void EmulatedRun::make_step(bool is_last) {
  const hal::TimeNs step_ns = machine_.next_step_ns();
  if (is_last || step_ns >= next_listening_ns_) {
    next_listening_ns_ = step_ns + kListeningPeriod_ns;
    machine_.step();
  } else {
    machine_.coast();
  }
}

void EmulatedRun::apply_faults() {
  const hal::TimeNs since_start_ns = machine_.next_step_ns() - machine_.start_ns();
  for (; next_fault_ < config_.faults.size(); ++next_fault_) {
    const PlannedFault& planned = config_.faults[next_fault_];
    if (1e9 * planned.at_s > static_cast<double>(since_start_ns)) {
      return;
    }
    for (std::size_t i = 0; i < machine_.joints(); ++i) {
      if (planned.joint.value_or(i) == i) {
        machine_.set_fault(i, planned.fault);
      }
    }
  }
}

void EmulatedRun::keep_truth() {
  if (config_.truth_period_ns <= 0 || machine_.truth().time_ns < next_truth_ns_) {
    return;
  }
  truth_.push_back(machine_.truth());
  while (next_truth_ns_ <= machine_.truth().time_ns) {
    next_truth_ns_ += config_.truth_period_ns;
  }
}

ClockedRun::ClockedRun(EmulatedRun& run, hal::SimulatedClock& clock) : run_(run), clock_(clock) {
  clock_.attach(*this);
}

ClockedRun::~ClockedRun() {
  clock_.detach(*this);
}

}  // namespace tactus::host
