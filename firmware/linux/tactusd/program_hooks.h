// Joins the loop of tactusd with the program: the requests that it asks for, and the places that it
// reports to. Real time.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <span>

#include "firmware/control/controller.h"
#include "firmware/linux/realtime/crash_stop.h"
#include "firmware/linux/tactusd/loop.h"
#include "firmware/linux/tactusd/run_device.h"
#include "firmware/linux/tactusd/supervisor.h"
#include "rendering/limits.h"

namespace tactus::firmware {

// Connects the loop with the rest of the program: requests come from the command queues and from
// --enable, and every tick goes to the telemetry of each device and to the supervisor.
class ProgramHooks {
 public:
  // The parts of the program that the loop works with. They must outlive the object.
  struct Parts {
    // The devices in the order of the controller's.
    std::span<RunDevice* const> devices;
    Supervisor& supervisor;
    // The signal that ends the program; 0: none has come.
    const std::atomic<int>& end_signal;
  };

  // `enable`: the option --enable.
  ProgramHooks(const Parts& parts, bool enable) : parts_(parts), enable_(enable) {}

  [[nodiscard]] bool stopping() const {
    return parts_.end_signal.load(std::memory_order_relaxed) != 0;
  }
  [[nodiscard]] static bool has_crashed() { return has_helper_crashed(); }

  // Takes the operators' requests. With --enable, homes and enables all devices until an operator
  // sends one.
  void take_requests(Controller& controller, std::span<Request> requests) const {
    for (std::size_t i = 0; i < requests.size(); ++i) {
      requests[i] = parts_.devices[i]->queue().before_tick(controller);
    }
    const bool is_operated = std::ranges::any_of(
        parts_.devices, [](RunDevice* device) { return device->queue().is_operated(); });
    if (enable_ && !is_operated) {
      for (std::size_t i = 0; i < requests.size(); ++i) {
        requests[i] = request_toward_active(controller.mode(i));
      }
    }
  }

  void publish(Controller& controller, const LoopTick& tick) {
    // The flight recorder gets the first device's tick after those of the others.
    for (std::size_t i = parts_.devices.size(); i > 0; --i) {
      parts_.devices[i - 1]->publish(controller, tick);
      modes_[i - 1] = controller.mode(i - 1);
    }
    parts_.supervisor.note(std::span(modes_).first(parts_.devices.size()));
  }

 private:
  Parts parts_;
  bool enable_;
  std::array<Mode, rendering::kMaxTools> modes_{};
};

}  // namespace tactus::firmware
