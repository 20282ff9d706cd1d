// Explains the ticks of a loop while a reader of the live telemetry wants it. The loop's thread.
#pragma once

#include <cstddef>
#include <cstdint>

#include "firmware/control/controller.h"
#include "firmware/linux/telemetry/telemetry_writer.h"
#include "firmware/telemetry/tick_explainer.h"

namespace tactus::firmware {

// The explanations of one device of a controller, which has no other watcher of it.
class ExplanationSource {
 public:
  // Explains the ticks of the device of that number, 0 for the first and by default. Call before
  // the loop starts.
  void set_device(std::size_t device) { device_ = device; }

  // Publishes the explanation of the tick that has ended, and decides whether the next one is
  // watched. `due_ns` is LoopTimes::scheduled_ns of the tick. Real time: while nobody wants
  // explanations, it reads one flag and the tick computes nothing for them.
  void after_tick(Controller& controller, std::int64_t due_ns, TelemetryWriter& writer) {
    const bool is_wanted = writer.wants_explanations();
    if (is_wanted || is_on_) {
      publish(controller, due_ns, writer);
      turn(controller, is_wanted);
    }
  }

 private:
  // Publishes the tick if it was watched.
  void publish(const Controller& controller, std::int64_t due_ns, TelemetryWriter& writer);
  // Begins or ends to watch the controller.
  void turn(Controller& controller, bool on);

  std::size_t device_ = 0;
  TickExplainer explainer_;
  bool is_on_ = false;
};

}  // namespace tactus::firmware
