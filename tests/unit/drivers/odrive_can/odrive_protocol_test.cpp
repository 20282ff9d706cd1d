#include "drivers/odrive_can/odrive_protocol.h"

#include <gtest/gtest.h>

#include <numbers>
#include <string_view>

#include "tests/unit/drivers/candump.h"

namespace tactus::drivers::odrive {
namespace {

// The trace in ODrive's docs/can-protocol: node 0 idle, node 1 in closed loop.
TEST(ODriveProtocol, ReadsTheHeartbeatsOfThePublishedTrace) {
  const hal::CanFrame idle = frame_of("001#0000000001000000");
  EXPECT_EQ(node_of(idle.id), 0U);
  EXPECT_EQ(command_of(idle.id), Command::heartbeat);
  ASSERT_TRUE(read_heartbeat(idle));
  EXPECT_EQ(read_heartbeat(idle)->state, 1U);
  const hal::CanFrame closed = frame_of("021#0000000008000000");
  EXPECT_EQ(node_of(closed.id), 1U);
  ASSERT_TRUE(read_heartbeat(closed));
  EXPECT_EQ(read_heartbeat(closed)->state, 8U);
  EXPECT_EQ(read_heartbeat(closed)->error, 0U);
}

TEST(ODriveProtocol, ReadsTheStateInEveryVersionsHeartbeat) {
  for (const std::string_view text : {
           "021#0008000001000000",  // 0.5.1, 0.5.2: the state in four bytes
           "021#0008000001000080",  // 0.5.3: in one, trajectory done
           "021#0008000001010081",  // 0.5.6: flags of motor and controller
           "021#0008000001030100",  // 0.6: procedure result and trajectory done
       }) {
    const auto heartbeat = read_heartbeat(frame_of(text));
    ASSERT_TRUE(heartbeat) << text;
    EXPECT_EQ(heartbeat->error, 0x800U) << text;
    EXPECT_EQ(heartbeat->state, 1U) << text;
  }
  EXPECT_EQ(read_heartbeat(frame_of("021#0008000001030100"))->procedure_result, 3U);
}

TEST(ODriveProtocol, SendsTheFramesOfTheWorkedExamples) {
  EXPECT_EQ(text_of(set_input_torque(1, 0.25F)), "02E#0000803E");
  EXPECT_EQ(text_of(set_axis_state(1, AxisState::closed_loop)), "027#08000000");
  EXPECT_EQ(text_of(set_axis_state(1, AxisState::idle)), "027#01000000");
  EXPECT_EQ(text_of(set_torque_mode(1)), "02B#0100000001000000");
}

TEST(ODriveProtocol, AsksByRemoteOrByEmptyFrames) {
  EXPECT_EQ(text_of(request(1, Command::get_estimates, true)), "029#R");
  EXPECT_EQ(text_of(request(1, Command::get_estimates, false)), "029#");
  EXPECT_EQ(text_of(request(0, Command::get_version, true)), "000#R");
  EXPECT_EQ(text_of(request(kMaxNode, Command::get_error, true)), "7C3#R");
}

// One turn a second is 0000803F, 60 A is 00007042, in IEEE 754.
TEST(ODriveProtocol, SendsLimitsInTurnsPerSecondAndAmperes) {
  EXPECT_EQ(text_of(set_limits(2, 2.0 * std::numbers::pi, 60.0)), "04F#0000803F00007042");
  EXPECT_EQ(text_of(clear_errors(2)), "058#00");
}

TEST(ODriveProtocol, ReadsEstimatesOfTheWorkedExampleInRadians) {
  const auto estimates = read_estimates(frame_of("029#0000003F000000BE"));
  ASSERT_TRUE(estimates);
  EXPECT_DOUBLE_EQ(estimates->position_rad, std::numbers::pi);
  EXPECT_DOUBLE_EQ(estimates->velocity_rad_per_s, -std::numbers::pi / 4.0);
}

TEST(ODriveProtocol, ReadsEveryReplyByItsLayout) {
  const auto version = read_version(frame_of("000#0205020000060901"));
  ASSERT_TRUE(version);
  EXPECT_EQ(version->protocol, 2U);
  EXPECT_EQ(version->product_line, 5U);
  EXPECT_EQ(version->hardware_version, 2U);
  EXPECT_EQ(version->hardware_variant, 0U);
  EXPECT_EQ(version->major, 0U);
  EXPECT_EQ(version->minor, 6U);
  EXPECT_EQ(version->revision, 9U);
  EXPECT_TRUE(version->unreleased);
  const auto errors = read_errors(frame_of("023#2000000000000001"));
  EXPECT_EQ(errors->active, 0x20U);
  EXPECT_EQ(errors->disarm_reason, 0x0100'0000U);
  EXPECT_EQ(read_motor_error(frame_of("023#0000000008000000")), 0x8'0000'0000U);
  EXPECT_EQ(read_part_error(frame_of("024#0402000000000000")), 0x204U);
  EXPECT_EQ(read_temperature(frame_of("035#0000284200001042"))->inverter_C, 42.0);
  EXPECT_EQ(read_temperature(frame_of("035#0000284200001042"))->motor_C, 36.0);
  EXPECT_EQ(read_bus_power(frame_of("037#0000C0410000403F"))->bus_V, 24.0);
  EXPECT_EQ(read_bus_power(frame_of("037#0000C0410000403F"))->bus_A, 0.75);
  EXPECT_EQ(read_current(frame_of("034#0000803F0000003F"))->setpoint_A, 1.0);
  EXPECT_EQ(read_current(frame_of("034#0000803F0000003F"))->measured_A, 0.5);
  EXPECT_EQ(read_torques(frame_of("03C#0000803E0000003E"))->target_Nm, 0.25);
  EXPECT_EQ(read_torques(frame_of("03C#0000803E0000003E"))->estimate_Nm, 0.125);
}

TEST(ODriveProtocol, RefusesFramesOfAnotherKindOrLength) {
  for (const std::string_view text :
       {"029#", "029#00", "029#00000000000000", "029#R", "029##00000000000000000"}) {
    const hal::CanFrame frame = frame_of(text);
    EXPECT_FALSE(read_version(frame)) << text;
    EXPECT_FALSE(read_heartbeat(frame)) << text;
    EXPECT_FALSE(read_estimates(frame)) << text;
    EXPECT_FALSE(read_errors(frame)) << text;
    EXPECT_FALSE(read_motor_error(frame)) << text;
    EXPECT_FALSE(read_part_error(frame)) << text;
    EXPECT_FALSE(read_temperature(frame)) << text;
    EXPECT_FALSE(read_bus_power(frame)) << text;
    EXPECT_FALSE(read_current(frame)) << text;
    EXPECT_FALSE(read_torques(frame)) << text;
  }
}

TEST(ODriveProtocol, EveryFrameItSendsIsWellFormed) {
  for (std::uint8_t node = 0; node <= kMaxNode; ++node) {
    for (const hal::CanFrame& frame :
         {request(node, Command::get_version, true), request(node, Command::get_version, false),
          set_axis_state(node, AxisState::idle), set_torque_mode(node),
          set_input_torque(node, 1.0F), set_limits(node, 1.0, 1.0), clear_errors(node)}) {
      EXPECT_TRUE(hal::is_valid(frame)) << text_of(frame);
      EXPECT_EQ(node_of(frame.id), node);
    }
  }
}

}  // namespace
}  // namespace tactus::drivers::odrive
