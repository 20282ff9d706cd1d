// Watches the ticks of one tool and explains them. `tactus touch --explain` uses it.
#pragma once

#include <cstddef>
#include <cstdint>

#include "firmware/telemetry/step_times.h"
#include "host_tools/explain/explained_tick.h"
#include "rendering/contact/tick_watcher.h"
#include "rendering/touch.h"

namespace tactus::host {

// One object explains one tick after the other: begin(), the world's touch with this watcher,
// finish().
class Explainer final : public rendering::TickWatcher {
 public:
  // `tool_radius_m` is the radius of the sphere that the shared proxy is the centre of, m. The
  // clock measures the steps; null: they have no times.
  explicit Explainer(double tool_radius_m, firmware::NowNs now_ns = nullptr)
      : tool_radius_m_(tool_radius_m), timer_(now_ns), has_clock_(now_ns != nullptr) {}

  // Begins a tick.
  void begin();
  // Returns the explained tick, valid until the next begin(), with its number, its time (s) and the
  // tool (world frame, m). The stages have the times of the steps outside of the touch.
  const ExplainedTick& finish(std::uint64_t number, double t_s, const Vec3& tool_W,
                              const rendering::Touch& touch,
                              const firmware::StageTimes& stage_ns = {});

  void see_step(rendering::TickStep step) override { timer_.end(step); }
  void see(const rendering::WatchedSubGoal& sub_goal) override;
  void see_end(const rendering::MovingProxy& proxy, bool is_put_back) override;
  void see(const rendering::WatchedObject& object,
           const rendering::WatchedFormulaStep& step) override;
  void see(const rendering::WatchedObject& object, const rendering::MeshFeature& feature) override;
  void see(const rendering::WatchedObject& object,
           const rendering::WatchedSegment& segment) override;

 private:
  // Ends the last move at `p_W`, and says how it ended.
  void end_move(const Vec3& p_W, bool is_put_back);

  double tool_radius_m_;
  ExplainedTick tick_;
  // The advances of this tick that have ended.
  std::size_t passes_ = 0;
  // True while the last move has no end.
  bool is_moving_ = false;
  // The proxy and its friction at the end of the last tick; not known before the first.
  Vec3 last_proxy_W_ = Vec3::Zero();
  bool has_last_ = false;
  rendering::FrictionState last_friction_ = rendering::FrictionState::free;
  firmware::StepTimer timer_;
  bool has_clock_;
};

}  // namespace tactus::host
