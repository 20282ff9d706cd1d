#include "firmware/control/tick_record.h"

#include "firmware/limits.h"
#include "firmware/safety/faults.h"

namespace tactus::firmware {

void open_record(const NextTick& next, const drivers::JointSample& sample, Request request,
                 double rate_hz, TelemetryRecord& record) {
  const TelemetryRecord before = record;
  record = TelemetryRecord{};
  record.counters = before.counters;
  record.state_hash = before.state_hash;
  record.tick = next.number;
  record.request = request;
  record.change = next.change;
  record.device_status = sample.status;
  record.sample_age_us = sample.age_us;
  record.loop_status = next.loop.status;
  record.missed_ticks = next.loop.missed_ticks;
  record.effort_known = sample.effort_known;
  record.effort_is_new = sample.effort_is_new;
  record.time_s = static_cast<double>(record.tick) / rate_hz;
  for (std::size_t joint = 0; joint < kJointCount; ++joint) {
    record.joint_position[joint] = sample.position[joint];
    record.joint_velocity[joint] = sample.velocity[joint];
    record.joint_measured[joint] = sample.effort[joint];
  }
}

void record_touch(const rendering::Touch& touch, TelemetryRecord& record) {
  record.contact = touch.contact;
  record.friction = touch.friction;
  record.touch_flags = touch.flags;
  record.object = touch.object;
  record.sub_goals = touch.sub_goals;
  record.planes = touch.planes;
  record.proxy_W = to_triple(touch.proxy_W);
  record.normal_W = to_triple(touch.normal_W);
  record.force_rendered_W = to_triple(touch.force_W);
  record.depth_m = touch.depth_m;
  record.short_of_goal_m = touch.short_of_goal_m;
  record.counters.touch_flagged += touch.flags != rendering::kTouchClean ? 1U : 0U;
}

void record_efforts(const ActiveEfforts& efforts, TelemetryRecord& record) {
  for (std::size_t joint = 0; joint < kJointCount; ++joint) {
    const auto axis = static_cast<Eigen::Index>(joint);
    record.joint_gravity[joint] = efforts.gravity[axis];
    record.joint_compensation[joint] = efforts.friction[axis];
  }
}

void close_record(const TickResults& results, TelemetryRecord& record) {
  const auto& [modes, guards, force, tool, command] = results;
  record.mode = modes.mode();
  record.faults = modes.faults();
  record.fault_joint = modes.fault_joint();
  record.fault_device = modes.fault_device();
  record.limits = modes.raised() & kLimitMask;
  record.energy_J = force.energy.ledger_J();
  record.passivity_J = force.passivity.credit_J();
  record.joint_effort = command.effort;
  record.tool_p_W = to_triple(tool.p_W);
  record.tool_v_W = to_triple(tool.v_W);
  record.counters.stale_samples = guards.sample.stale_count();
  record.counters.late_ticks = guards.loop.late_count();
  record.counters.limited_ticks += record.limits != 0 ? 1U : 0U;
  record.counters.faults_entered += modes.has_entered_fault() ? 1U : 0U;
  record.state_hash = state_hash(record, record.state_hash);
}

}  // namespace tactus::firmware
