// Watches the ticks of a controller in its loop and explains each in a message of fixed size. No
// heap, bounded time: a few microseconds a move (README.md). The loop's thread.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "firmware/telemetry/explanation.h"
#include "firmware/telemetry/record.h"
#include "firmware/telemetry/step_times.h"
#include "rendering/contact/tick_watcher.h"
#include "rendering/limits.h"

namespace tactus::firmware {

// One object explains one tick after the other: begin(), the controller's tick with this watcher,
// finish().
class TickExplainer final : public rendering::TickWatcher {
 public:
  // Sets the clock of the steps and begins a tick. Null: no clock.
  void begin(NowNs now_ns);
  // Returns the explanation of the tick with this record and due time (ns). `tool_radius_m` is the
  // radius of the sphere whose centre the shared proxy is, m.
  Explanation finish(const TelemetryRecord& record, std::int64_t time_ns, double tool_radius_m);

  void see_step(rendering::TickStep step) override { timer_.end(step); }
  void see(const rendering::WatchedSubGoal& sub_goal) override;
  void see_end(const rendering::MovingProxy& proxy, bool is_put_back) override;
  void see(const rendering::WatchedObject& object,
           const rendering::WatchedFormulaStep& step) override;
  void see(const rendering::WatchedObject& object, const rendering::MeshFeature& feature) override;
  void see(const rendering::WatchedObject& object,
           const rendering::WatchedSegment& segment) override;

 private:
  // A feature and the point of its surface that is nearest to the proxy.
  struct Place {
    rendering::ExplainedFeature feature;
    Vec3 surface_W;
  };

  // Takes over the active planes of a sub-goal.
  void take_planes(const rendering::WatchedSubGoal& sub_goal,
                   const rendering::WatchedConstraints& constraints);
  // Sets the feature, its numbers and the surface point of a tick in contact.
  void place_contact(const TelemetryRecord& record, double tool_radius_m);

  StepTimer timer_{nullptr};
  Explanation explanation_;
  // The hardest plane of the last move.
  std::optional<Place> hardest_;
  // The place of the shared proxy, or of the last facet that a textbook's method met.
  std::optional<Place> held_by_;
  // The features at which walks have ended, one for each object that has one.
  std::array<rendering::ExplainedFeature, rendering::kMaxIndependentObjects> walked_to_{};
  std::size_t walks_ = 0;
};

}  // namespace tactus::firmware
