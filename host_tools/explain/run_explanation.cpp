#include "host_tools/explain/run_explanation.h"

namespace tactus::host {
namespace {

Vec3 vector_of(const firmware::Triple& v) {
  return {v[0], v[1], v[2]};
}

}  // namespace

RunExplanation::RunExplanation(const std::filesystem::path& file, firmware::Controller& controller,
                               double tool_radius_m)
    : explainer_(tool_radius_m), steps_(file) {
  explainer_.begin();
  controller.watch(&explainer_);
}

void RunExplanation::add(const firmware::TelemetryRecord& record) {
  const rendering::Touch touch{.proxy_W = vector_of(record.proxy_W),
                               .normal_W = vector_of(record.normal_W),
                               .depth_m = record.depth_m,
                               .contact = record.contact,
                               .friction = record.friction,
                               .object = record.object,
                               .flags = record.touch_flags};
  steps_.add(explainer_.finish(record.tick, record.time_s, vector_of(record.tool_p_W), touch));
  explainer_.begin();
}

}  // namespace tactus::host
