// A device, a clock and hooks for the loop that follow a test's script and record their calls.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "firmware/control/controller.h"
#include "firmware/linux/tactusd/loop.h"
#include "hal/simulated/clock.h"

namespace tactus::testing {

// A device whose transfers take simulated time.
class SlowDevice {
 public:
  explicit SlowDevice(hal::SimulatedClock& clock) : clock_(&clock) {}

  static std::size_t joint_count() { return firmware::kJointCount; }
  void read(drivers::JointSample& sample) {
    clock_->advance_by(read_ns);
    sample = next;
  }
  std::uint32_t write(const drivers::JointCommand& command) {
    clock_->advance_by(write_ns);
    powered = command.enable;
    return drivers::kDeviceOk;
  }
  void clear_faults() {}

  drivers::JointSample next;
  hal::TimeNs read_ns = 100'000;
  hal::TimeNs write_ns = 20'000;
  bool powered = false;

 private:
  hal::SimulatedClock* clock_;
};
static_assert(drivers::Device<SlowDevice>);

struct SeenTick {
  firmware::LoopTick loop;
  firmware::Mode mode = firmware::Mode::init;
  std::uint64_t tick = 0;
};

// Homes and enables; `in_tick` acts before the tick of that number.
template <class InTick>
class EnablingHooks {
 public:
  explicit EnablingHooks(InTick in_tick) : in_tick_(in_tick) {}

  [[nodiscard]] bool stopping() const { return seen.size() >= stop_at; }
  [[nodiscard]] bool has_crashed() const { return seen.size() >= crash_at; }
  void take_requests(const firmware::Controller& controller,
                     std::span<firmware::Request> requests) {
    in_tick_(seen.size());
    for (std::size_t i = 0; i < requests.size(); ++i) {
      requests[i] = firmware::request_toward_active(controller.mode(i));
    }
  }
  void publish(const firmware::Controller& controller, const firmware::LoopTick& tick) {
    seen.push_back({tick, controller.mode(), controller.record().tick});
  }

  std::vector<SeenTick> seen;
  std::size_t stop_at = SIZE_MAX;
  std::size_t crash_at = SIZE_MAX;

 private:
  InTick in_tick_;
};

}  // namespace tactus::testing
