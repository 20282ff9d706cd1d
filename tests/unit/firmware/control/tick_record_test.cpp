#include "firmware/control/tick_record.h"

#include <gtest/gtest.h>

#include "firmware/safety/faults.h"

namespace tactus::firmware {
namespace {

TEST(TickRecord, OpensWithItsInputsAndGoesOnWithCountersAndHash) {
  TelemetryRecord record;
  record.counters.limited_ticks = 7;
  record.state_hash = 0x1234;
  record.depth_m = 1.0;
  const NextTick next{.number = 20,
                      .loop = {.status = kLoopLate, .missed_ticks = 2},
                      .change = {.place = {.parameter = Parameter::max_force}, .value = 3.0}};
  open_record(next, {.position = {0.1, 0.2, 0.3}, .age_us = 50}, Request::home, 2000.0, record);
  EXPECT_EQ(record.tick, 20U);
  EXPECT_EQ(record.time_s, 0.01);
  EXPECT_EQ(record.request, Request::home);
  EXPECT_EQ(record.loop_status, kLoopLate);
  EXPECT_EQ(record.missed_ticks, 2U);
  EXPECT_EQ(record.change.value, 3.0);
  EXPECT_EQ(record.joint_position[2], 0.3);
  EXPECT_EQ(record.sample_age_us, 50U);
  EXPECT_EQ(record.counters.limited_ticks, 7U);
  EXPECT_EQ(record.state_hash, 0x1234U);
  EXPECT_EQ(record.depth_m, 0.0) << "the last tick's results are gone";
}

TEST(TickRecord, CountsTouchesWithFlags) {
  TelemetryRecord record;
  record_touch({.force_W = {0.0, 2.0, 0.0}}, record);
  EXPECT_EQ(record.force_rendered_W[1], 2.0);
  EXPECT_EQ(record.counters.touch_flagged, 0U);
  record_touch({.flags = rendering::kTouchOverlap}, record);
  EXPECT_EQ(record.counters.touch_flagged, 1U);
}

TEST(TickRecord, KeepsThePartsOfTheEfforts) {
  TelemetryRecord record;
  record_efforts({.gravity = {1.0, 2.0, 3.0}, .friction = {4.0, 5.0, 6.0}}, record);
  EXPECT_EQ(record.joint_gravity[1], 2.0);
  EXPECT_EQ(record.joint_compensation[2], 6.0);
}

TEST(TickRecord, ClosesWithTheResultsAndTheirHash) {
  ModeMachine modes;
  Guards guards;
  const ForcePath force;
  const rendering::ToolState tool{.p_W = {0.1, 0.2, 0.3}};
  drivers::JointCommand command;
  command.effort[1] = 4.0;
  modes.raise(kLimitForce | kFaultOverspeed);
  guards.loop.check({.status = kLoopLate});
  TelemetryRecord record;
  const TickResults results{
      .modes = modes, .guards = guards, .force = force, .tool = tool, .command = command};
  close_record(results, record);
  EXPECT_EQ(record.mode, Mode::fault);
  EXPECT_EQ(record.faults, kFaultOverspeed);
  EXPECT_EQ(record.limits, kLimitForce);
  EXPECT_EQ(record.joint_effort[1], 4.0);
  EXPECT_EQ(record.tool_p_W[2], 0.3);
  EXPECT_EQ(record.counters.faults_entered, 1U);
  EXPECT_EQ(record.counters.limited_ticks, 1U);
  EXPECT_EQ(record.counters.late_ticks, 1U);
  EXPECT_EQ(record.state_hash, state_hash(record, 0));
  modes.begin_tick();
  close_record(results, record);
  EXPECT_EQ(record.counters.faults_entered, 1U);
}

}  // namespace
}  // namespace tactus::firmware
