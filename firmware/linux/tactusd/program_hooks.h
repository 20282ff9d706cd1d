// Joins the loop of tactusd with the program: the requests that it asks for, and the places that it
// reports to. Real time.
#pragma once

#include <atomic>

#include "drivers/composition/composed_device.h"
#include "firmware/control/controller.h"
#include "firmware/linux/commands/command_queue.h"
#include "firmware/linux/realtime/crash_stop.h"
#include "firmware/linux/tactusd/loop.h"
#include "firmware/linux/tactusd/run_telemetry.h"
#include "firmware/linux/tactusd/supervisor.h"

namespace tactus::firmware {

// Connects the loop with the rest of the program: requests come from the command queue and from
// --enable, and every tick goes to telemetry and to the supervisor.
class ProgramHooks {
 public:
  // The parts of the program that the loop works with. They must outlive the object.
  struct Parts {
    CommandQueue& queue;
    RunTelemetry& telemetry;
    Supervisor& supervisor;
    // True after a signal that ends the program.
    const std::atomic<bool>& stop_requested;
  };

  // `enable`: the option --enable.
  ProgramHooks(const Parts& parts, const drivers::ComposedDevice& device, bool enable)
      : parts_(parts), device_(&device), enable_(enable) {}

  [[nodiscard]] bool stopping() const {
    return parts_.stop_requested.load(std::memory_order_relaxed);
  }
  [[nodiscard]] bool has_crashed() const { return has_helper_crashed(); }

  // Returns the operator's request. With --enable, homes and enables until an operator sends one.
  [[nodiscard]] Request take_request(Controller& controller) const {
    const Request commanded = parts_.queue.before_tick(controller);
    const bool is_automatic = enable_ && !parts_.queue.is_operated();
    return is_automatic ? request_toward_active(controller.mode()) : commanded;
  }

  void publish(Controller& controller, const LoopTick& tick) {
    parts_.queue.after_tick(controller);
    parts_.telemetry.publish(controller, tick, *device_);
    parts_.supervisor.note(controller.mode());
  }

 private:
  Parts parts_;
  const drivers::ComposedDevice* device_;
  bool enable_;
};

}  // namespace tactus::firmware
