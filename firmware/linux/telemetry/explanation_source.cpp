#include "firmware/linux/telemetry/explanation_source.h"

namespace tactus::firmware {

void ExplanationSource::publish(const Controller& controller, std::int64_t due_ns,
                                TelemetryWriter& writer) {
  if (is_on_) {
    writer.publish(
        explainer_.finish(controller.record(device_), due_ns, controller.tool_radius_m()));
  }
}

void ExplanationSource::turn(Controller& controller, bool on) {
  if (on) {
    explainer_.begin(controller.clock());
  }
  controller.watch(on ? &explainer_ : nullptr, device_);
  is_on_ = on;
}

}  // namespace tactus::firmware
