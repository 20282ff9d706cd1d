#include "tests/unit/host_tools/monitor/example_run.h"

#include "firmware/safety/faults.h"

namespace tactus::host {

firmware::RecordedTick example_tick(std::uint64_t tick, std::int64_t latency_us) {
  firmware::RecordedTick example;
  firmware::TelemetryRecord& record = example.record;
  record.tick = tick;
  record.time_s = 1e-3 * static_cast<double>(tick);
  record.mode = firmware::Mode::active;
  record.contact = rendering::ContactKind::face;
  record.friction = rendering::FrictionState::slip;
  record.object = 2;
  record.depth_m = 0.001234;
  record.sample_age_us = 120;
  record.joint_position = {0.1, -1.25, 3.14159265};
  record.joint_velocity = {0.0, 0.5, -12.0};
  record.joint_effort = {0.02, -0.4, 1.5};
  record.joint_compensation = {0.0, 0.001, -0.002};
  record.tool_p_W = {0.0101, -0.0202, 0.0303};
  record.proxy_W = {0.0101, -0.0202, 0.031534};
  record.force_commanded_W = {0.0, 0.6, 0.8};
  record.energy_J = {-0.5, -0.25, 0.001, 0.0, 0.0, -0.01, 0.002};
  record.passivity_J = 0.757;
  record.counters.late_ticks = 3;
  record.stage_ns = {.read = 45'000,
                     .check = 200,
                     .kinematics = 900,
                     .touch = 1'500,
                     .safety = 300,
                     .write = 30'000};
  example.loop.scheduled_ns = static_cast<std::int64_t>(tick) * 1'000'000;
  example.loop.woke_ns = example.loop.scheduled_ns + 1'000 * latency_us;
  example.loop.done_ns = example.loop.woke_ns + 80'000;
  example.joint_count = 3;
  return example;
}

firmware::Explanation example_explanation() {
  const firmware::TelemetryRecord record = example_tick(100, 3).record;
  const rendering::ExplainedFeature edge{
      .object = 2, .kind = rendering::ContactKind::edge, .face = 17, .edge = 1};
  firmware::Explanation example{
      .tick = record.tick,
      .feature = edge,
      .is_feature_known = true,
      .friction = record.friction,
      .moves = 6,
      .tool_W = record.tool_p_W,
      .proxy_W = record.proxy_W,
      .surface_W = {0.0101, -0.0202, 0.029534},
      .normal_W = {0.0, 0.0, 1.0},
      .depth_m = record.depth_m,
      .plane_count = 2,
      .has_circle = true,
      .circle = {.static_radius_m = 0.00074, .dynamic_radius_m = 0.00049, .lag_m = 0.00082},
      .step_ns = {45'200, 900, 800, 400, 200, 30'300, 100}};
  example.planes[0] = {.feature = edge,
                       .normal_W = {0.6, 0.0, 0.8},
                       .tool_distance_m = -0.0009,
                       .multiplier_m = 0.0007};
  example.planes[1] = {.feature = {.object = 2, .kind = rendering::ContactKind::face, .face = 18},
                       .normal_W = {-0.6, 0.0, 0.8},
                       .tool_distance_m = -0.0008,
                       .multiplier_m = 0.0006};
  return example;
}

RunView example_run() {
  RunView view;
  view.take(RunInfo{{"device", "WoodenHaptics on ODrive"}});
  for (std::uint64_t tick = 1; tick <= 100; ++tick) {
    view.take(example_tick(tick, tick == 50 ? 60 : tick == 70 ? 1500 : 3));
  }
  return view;
}

}  // namespace tactus::host
