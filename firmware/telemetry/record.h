// The record of one tick: its inputs and results, of fixed size, copied as bytes. All but the stage
// times depends only on the inputs up to this tick.
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

using Triple = std::array<double, 3>;  // x, y, z

inline Triple to_triple(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

// Numbers counted since configure().
struct TickCounters {
  std::uint32_t stale_samples = 0;   // samples that were too old
  std::uint32_t faults_entered = 0;  // times that the mode became fault
  std::uint32_t limited_ticks = 0;   // ticks with any limit
  std::uint32_t touch_flagged = 0;   // ticks with any touch flag
  std::uint32_t late_ticks = 0;      // ticks that the loop reported as late
};

// Duration of each stage of a tick, ns, measured with the controller's clock; all are 0 without
// one. run_tick measures `read` and `write`, the transfers with the device.
struct StageTimes {
  std::uint32_t read = 0;
  std::uint32_t check = 0;
  std::uint32_t kinematics = 0;
  std::uint32_t touch = 0;
  std::uint32_t safety = 0;  // force limits, joint efforts and their guards
  std::uint32_t write = 0;
};

struct TelemetryRecord {
  std::uint64_t tick = 0;  // 0 is the first after configure()
  double time_s = 0.0;     // tick / rate_hz

  Mode mode = Mode::init;  // mode after the tick
  Request request = Request::none;
  rendering::ContactKind contact = rendering::ContactKind::none;
  rendering::FrictionState friction = rendering::FrictionState::free;
  std::uint64_t faults = 0;         // latched FaultBits
  std::uint64_t limits = 0;         // FaultBits of the limits of this tick
  std::uint32_t device_status = 0;  // DeviceStatus of the sample and of the last write
  std::uint32_t sample_age_us = 0;
  std::uint32_t loop_status = 0;   // LoopStatus
  std::uint32_t missed_ticks = 0;  // ticks that the loop skipped before this one
  std::uint32_t touch_flags = 0;   // TouchFlags
  std::uint32_t object = 0;        // index of the touched object; meaningful in contact only
  std::uint16_t sub_goals = 0;     // straight moves of the proxy in this tick
  std::uint16_t planes = 0;        // contact planes of the proxy
  // Joint positions (rad or m), velocities (rad/s or m/s) and efforts (N m or N).

  std::array<double, drivers::kMaxJoints> joint_position{};
  std::array<double, drivers::kMaxJoints> joint_velocity{};
  std::array<double, drivers::kMaxJoints> joint_effort{};  // commanded
  Triple tool_p_W{};                                       // m
  Triple tool_v_W{};                                       // m/s, filtered
  Triple proxy_W{};                                        // m
  Triple normal_W{};                                       // unit contact normal, outward
  Triple force_rendered_W{};                               // N, the force that rendering computed
  Triple force_commanded_W{};  // N, the force of the commanded efforts on the hand, without the
                               // compensation of the joints' friction and of gravity
  double depth_m = 0.0;        // penetration depth
  double passivity_J = 0.0;    // credit of the passivity observer; below 0 the hand got energy

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
  // The efforts that the drives measured, and a bit for each joint with a measurement. Hashed if
  // any joint has one.
  std::array<double, drivers::kMaxJoints> joint_measured{};
  std::uint32_t effort_known = 0;
  // The joint of a latched motor_reversed or effort_mismatch, 1 for the first; 0: none. Not hashed,
  // because `faults` is.
  std::uint32_t fault_joint = 0;
  StageTimes stage_ns;  // not hashed
};
static_assert(std::is_trivially_copyable_v<TelemetryRecord>);

// Returns the hash of a record. `previous` is the hash of the tick before. The fields are taken in
// order as 64-bit words (doubles by their bits, all NaNs alike). Each word w changes the hash h to
// (h ^ w) * 0x9E3779B97F4A7C15, then to h ^ (h >> 32).
std::uint64_t state_hash(const TelemetryRecord& record, std::uint64_t previous);

}  // namespace tactus::firmware
