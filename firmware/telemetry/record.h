// The record of one tick: its inputs and results, of fixed size, copied as bytes. All but the stage
// times depends only on the inputs up to this tick. The tick fills it; record_fields.h lists the
// fields by name.
#pragma once

#include <array>
#include <cstdint>
#include <type_traits>

#include "drivers/device.h"
#include "firmware/control/mode.h"
#include "firmware/control/parameters.h"
#include "firmware/safety/energy_ledger.h"
#include "rendering/touch.h"

namespace tactus::firmware {

// A vector's x, y and z, in the frame and unit of the field that holds it.
using Triple = std::array<double, 3>;

// Returns the vector's coordinates.
inline Triple to_triple(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

// Numbers counted since configure().
struct TickCounters {
  // Samples that were too old.
  std::uint32_t stale_samples = 0;
  // The number of times that the mode became `fault`.
  std::uint32_t faults_entered = 0;
  // Ticks with any limit.
  std::uint32_t limited_ticks = 0;
  // Ticks with any touch flag.
  std::uint32_t touch_flagged = 0;
  // Ticks that the loop reported as late.
  std::uint32_t late_ticks = 0;
};

// The duration of each stage of a tick, ns, measured with the controller's clock; all are 0 without
// one. run_tick measures `read` and `write`, the transfers with the device.
struct StageTimes {
  std::uint32_t read = 0;
  std::uint32_t check = 0;
  std::uint32_t kinematics = 0;
  std::uint32_t touch = 0;
  // Force limits, joint efforts and their guards.
  std::uint32_t safety = 0;
  std::uint32_t write = 0;
};

// The record. State hashes contain all fields that decide about later ticks.
struct TelemetryRecord {
  // The number of the tick; 0 is the first after configure().
  std::uint64_t tick = 0;
  // The tick's number divided by the rate, s.
  double time_s = 0.0;

  // The mode after the tick.
  Mode mode = Mode::init;
  // The request that the tick got.
  Request request = Request::none;
  // The kind of contact and the state of friction that the touch reports.
  rendering::ContactKind contact = rendering::ContactKind::none;
  rendering::FrictionState friction = rendering::FrictionState::free;
  // The latched FaultBits.
  std::uint64_t faults = 0;
  // The FaultBits of this tick's limits.
  std::uint64_t limits = 0;
  // The DeviceStatus bits of the sample and of the last write.
  std::uint32_t device_status = 0;
  // The age of the sample that the device reported.
  std::uint32_t sample_age_us = 0;
  // LoopStatus bits.
  std::uint32_t loop_status = 0;
  // The number of ticks that the loop skipped before this one.
  std::uint32_t missed_ticks = 0;
  // TouchFlags of the touch.
  std::uint32_t touch_flags = 0;
  // The index of the touched object; it has a meaning in contact only.
  std::uint32_t object = 0;
  // The number of straight moves of the proxy in this tick.
  std::uint16_t sub_goals = 0;
  // The number of the proxy's contact planes.
  std::uint16_t planes = 0;
  // The joints' positions, rad or m, and velocities, rad/s or m/s, of the sample.
  std::array<double, drivers::kMaxJoints> joint_position{};
  std::array<double, drivers::kMaxJoints> joint_velocity{};
  // The commanded efforts, N m or N.
  std::array<double, drivers::kMaxJoints> joint_effort{};
  // The tool's position, m, world frame.
  Triple tool_p_W{};
  // The velocity of the tool, m/s, world frame, after the low-pass.
  Triple tool_v_W{};
  // The proxy's position, m, world frame.
  Triple proxy_W{};
  // The contact normal, a unit vector out of the surface, world frame.
  Triple normal_W{};
  // The force on the hand that rendering computed, N, world frame.
  Triple force_rendered_W{};
  // The force of the commanded efforts on the hand, N, world frame, without the compensation of the
  // joints' friction and of gravity.
  Triple force_commanded_W{};
  // The penetration depth: the stretch along the normal.
  double depth_m = 0.0;
  // The credit of the passivity observer. Below 0 the surfaces have given the hand energy.
  double passivity_J = 0.0;

  TickCounters counters;
  // Hash of all fields above, in order, and of the previous tick's hash.
  std::uint64_t state_hash = 0;
  // The part of joint_effort that compensates friction. Not hashed, because joint_effort is.
  std::array<double, drivers::kMaxJoints> joint_compensation{};
  // The part of joint_effort that holds the mechanism's weights. Not hashed either.
  std::array<double, drivers::kMaxJoints> joint_gravity{};
  // Energy given to the hand, by source. Not hashed: later output depends on passivity_J only.
  EnergyLedger energy_J{};
  // While a limit acts, the source that gives most: of energy for limiting_passivity, of force for
  // other limits. Not hashed.
  EnergySource limited_source = EnergySource::contact;
  // The parameter change that takes effect in this tick. Not hashed, because its effects are.
  ParameterChange change;
  // The efforts that the drives measured, N m or N. They are hashed if any joint has one.
  std::array<double, drivers::kMaxJoints> joint_measured{};
  // A bit for each joint with a measurement; bit 0 is the first joint.
  std::uint32_t effort_known = 0;
  // A bit for each joint whose drive has measured anew since the last tick.
  std::uint32_t effort_is_new = 0;
  // The joint of a latched motor_reversed or effort_mismatch, 1 for the first; 0: none. Not hashed,
  // because `faults` is.
  std::uint32_t fault_joint = 0;
  // The device of a latched other_device, 1 for the controller's first; 0: none. Not hashed either.
  std::uint32_t fault_device = 0;
  // The distance of the proxy from its goal when a limit ended its moves, m; 0 in other ticks. It
  // is hashed if it is not 0.
  double short_of_goal_m = 0.0;
  // The stage times. Not hashed.
  StageTimes stage_ns;
};
static_assert(std::is_trivially_copyable_v<TelemetryRecord>);

// Returns the hash of a record. `previous` is the hash of the tick before. The fields are taken in
// order as 64-bit words (doubles by their bits, all NaNs alike). Each word w changes the hash h to
// (h ^ w) * 0x9E3779B97F4A7C15, then to h ^ (h >> 32).
std::uint64_t state_hash(const TelemetryRecord& record, std::uint64_t previous);

}  // namespace tactus::firmware
