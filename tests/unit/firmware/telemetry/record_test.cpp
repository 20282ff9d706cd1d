#include "firmware/telemetry/record.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <vector>

namespace tactus::firmware {
namespace {

TEST(StateHash, FollowsItsDocumentedRecipe) {
  // 16 leading fields, 18 joint values, 6 vectors, depth, passivity and 5 counters: all zero in an
  // empty record, so each word only multiplies and folds.
  constexpr int kWords = 16 + 18 + 18 + 2 + 5;
  std::uint64_t expected = 42;
  for (int word = 0; word < kWords; ++word) {
    expected *= 0x9E37'79B9'7F4A'7C15U;
    expected ^= expected >> 32;
  }
  EXPECT_EQ(state_hash(TelemetryRecord{}, 42), expected);
}

TEST(StateHash, ChangesWithEveryFieldButTheStageTimes) {
  using Change = std::function<void(TelemetryRecord&)>;
  const std::vector<Change> changes = {
      [](TelemetryRecord& r) { r.tick = 1; },
      [](TelemetryRecord& r) { r.time_s = 1.0; },
      [](TelemetryRecord& r) { r.mode = Mode::active; },
      [](TelemetryRecord& r) { r.request = Request::home; },
      [](TelemetryRecord& r) { r.contact = rendering::ContactKind::edge; },
      [](TelemetryRecord& r) { r.friction = rendering::FrictionState::slip; },
      [](TelemetryRecord& r) { r.faults = 1; },
      [](TelemetryRecord& r) { r.limits = 1; },
      [](TelemetryRecord& r) { r.device_status = 1; },
      [](TelemetryRecord& r) { r.sample_age_us = 1; },
      [](TelemetryRecord& r) { r.loop_status = 1; },
      [](TelemetryRecord& r) { r.missed_ticks = 1; },
      [](TelemetryRecord& r) { r.touch_flags = 1; },
      [](TelemetryRecord& r) { r.object = 1; },
      [](TelemetryRecord& r) { r.sub_goals = 1; },
      [](TelemetryRecord& r) { r.planes = 1; },
      [](TelemetryRecord& r) { r.joint_position[5] = 1e-300; },
      [](TelemetryRecord& r) { r.joint_velocity[0] = 1e-300; },
      [](TelemetryRecord& r) { r.joint_effort[2] = 1e-300; },
      [](TelemetryRecord& r) { r.tool_p_W[0] = 1e-300; },
      [](TelemetryRecord& r) { r.tool_v_W[1] = 1e-300; },
      [](TelemetryRecord& r) { r.proxy_W[2] = 1e-300; },
      [](TelemetryRecord& r) { r.normal_W[0] = 1e-300; },
      [](TelemetryRecord& r) { r.force_rendered_W[1] = 1e-300; },
      [](TelemetryRecord& r) { r.force_commanded_W[2] = 1e-300; },
      [](TelemetryRecord& r) { r.depth_m = 1e-300; },
      [](TelemetryRecord& r) { r.passivity_J = 1e-300; },
      [](TelemetryRecord& r) { r.counters.stale_samples = 1; },
      [](TelemetryRecord& r) { r.counters.faults_entered = 1; },
      [](TelemetryRecord& r) { r.counters.limited_ticks = 1; },
      [](TelemetryRecord& r) { r.counters.touch_flagged = 1; },
      [](TelemetryRecord& r) { r.counters.late_ticks = 1; },
      [](TelemetryRecord& r) { r.short_of_goal_m = 1e-300; },
  };
  std::vector<std::uint64_t> seen = {state_hash(TelemetryRecord{}, 0)};
  for (const Change& change : changes) {
    TelemetryRecord record;
    change(record);
    const std::uint64_t hash = state_hash(record, 0);
    EXPECT_EQ(std::count(seen.begin(), seen.end(), hash), 0);
    seen.push_back(hash);
  }
  TelemetryRecord timed;
  timed.stage_ns.touch = 123;
  timed.state_hash = 456;
  EXPECT_EQ(state_hash(timed, 0), seen.front());
}

TEST(StateHash, TakesMeasuredEffortsOnceADriveMeasures) {
  TelemetryRecord record;
  record.joint_measured[1] = 1.0;
  EXPECT_EQ(state_hash(record, 0), state_hash(TelemetryRecord{}, 0));
  record.effort_known = 0b010;
  const std::uint64_t known = state_hash(record, 0);
  EXPECT_NE(known, state_hash(TelemetryRecord{}, 0));
  record.joint_measured[1] = 2.0;
  const std::uint64_t other = state_hash(record, 0);
  EXPECT_NE(other, known);
  record.effort_is_new = 0b010;
  EXPECT_NE(state_hash(record, 0), other);
}

TEST(StateHash, ChainsFromTheTickBefore) {
  EXPECT_NE(state_hash(TelemetryRecord{}, 1), state_hash(TelemetryRecord{}, 2));
}

TEST(StateHash, TakesEveryNaNAlike) {
  TelemetryRecord one;
  TelemetryRecord other;
  one.joint_position[0] = std::numeric_limits<double>::quiet_NaN();
  other.joint_position[0] = -std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(state_hash(one, 0), state_hash(other, 0));
}

}  // namespace
}  // namespace tactus::firmware
