#include "host_tools/explain/run_explanation.h"

#include "host_tools/explain/tick_summary.h"

namespace tactus::host {
namespace {

Vec3 vector_of(const firmware::Triple& v) {
  return {v[0], v[1], v[2]};
}

}  // namespace

RunExplanation::RunExplanation(const std::filesystem::path& file, firmware::Controller& controller,
                               double tool_radius_m, firmware::NowNs now_ns, std::size_t device)
    : explainer_(tool_radius_m, now_ns), steps_(file) {
  if (now_ns != nullptr) {
    controller.set_clock(now_ns);
  }
  explainer_.begin();
  controller.watch(&explainer_, device);
}

firmware::Explanation RunExplanation::add(const firmware::TelemetryRecord& record,
                                          const std::optional<firmware::StepTimes>& recorded_ns) {
  const rendering::Touch touch{.proxy_W = vector_of(record.proxy_W),
                               .normal_W = vector_of(record.normal_W),
                               .depth_m = record.depth_m,
                               .contact = record.contact,
                               .friction = record.friction,
                               .object = record.object,
                               .flags = record.touch_flags};
  ExplainedTick tick = explainer_.finish(record.tick, record.time_s, vector_of(record.tool_p_W),
                                         touch, record.stage_ns);
  if (recorded_ns) {
    tick.step_ns = recorded_ns;
  }
  steps_.add(tick);
  explainer_.begin();
  return summary_of(tick);
}

}  // namespace tactus::host
