// What one tick did: fixed size, copied as bytes. Everything but the stage times is a function of
// the inputs so far.
#pragma once

#include <array>
#include <cstdint>
#include <type_traits>

#include "drivers/device.h"
#include "firmware/control/mode.h"
#include "firmware/control/parameters.h"
#include "firmware/safety/energy_ledger.h"
#include "rendering/world/touch.h"

namespace tactus::firmware {

using Triple = std::array<double, 3>;  // x, y, z

inline Triple to_triple(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

// Since configure().
struct TickCounters {
  std::uint32_t stale_samples = 0;
  std::uint32_t faults_entered = 0;  // times that the mode became fault
  std::uint32_t limited_ticks = 0;   // ticks with any limit
  std::uint32_t touch_flagged = 0;   // ticks with any touch flag
  std::uint32_t late_ticks = 0;      // as the loop reported them
};

// ns, by the clock given to the controller; all zero without one. `read` and `write` are the
// device's, by run_tick.
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

  Mode mode = Mode::init;  // after the tick
  Request request = Request::none;
  rendering::ContactKind contact = rendering::ContactKind::none;
  rendering::FrictionState friction = rendering::FrictionState::free;
  std::uint64_t faults = 0;         // FaultBits latched
  std::uint64_t limits = 0;         // FaultBits of limits, this tick's
  std::uint32_t device_status = 0;  // DeviceStatus of the sample and of the last write
  std::uint32_t sample_age_us = 0;
  std::uint32_t loop_status = 0;   // LoopStatus
  std::uint32_t missed_ticks = 0;  // skipped by the loop before this one
  std::uint32_t touch_flags = 0;   // TouchFlags
  std::uint32_t object = 0;        // touched object, meaningful in contact
  std::uint16_t sub_goals = 0;
  std::uint16_t planes = 0;

  std::array<double, drivers::kMaxJoints> joint_position{};
  std::array<double, drivers::kMaxJoints> joint_velocity{};
  std::array<double, drivers::kMaxJoints> joint_effort{};  // commanded
  Triple tool_p_W{};                                       // m
  Triple tool_v_W{};                                       // m/s, filtered
  Triple proxy_W{};                                        // m
  Triple normal_W{};
  Triple force_rendered_W{};   // N, as the touch gave it
  Triple force_commanded_W{};  // N, what the commanded efforts put on the hand, without the
                               // compensation of the joints' friction and of gravity
  double depth_m = 0.0;
  double passivity_J = 0.0;  // what the passivity observer has: below 0 the hand was given energy

  TickCounters counters;
  std::uint64_t state_hash =
      0;  // of all fields above, in order, and of the hash of the tick before
  // What of joint_effort is friction compensation; not hashed, joint_effort is.
  std::array<double, drivers::kMaxJoints> joint_compensation{};
  // What of it holds the mechanism's own weights up; not hashed either.
  std::array<double, drivers::kMaxJoints> joint_gravity{};
  // By source, not hashed: passivity_J is what the next output depends on.
  EnergyLedger energy_J{};
  // When a limit acts: the source that gives most, of energy for limiting_passivity and of force
  // otherwise. Not hashed.
  EnergySource limited_source = EnergySource::contact;
  // The parameter that this tick is the first to have changed; not hashed, what it does is.
  ParameterChange change;
  // What the drives measured, and a bit for each joint of which they did; hashed where any did.
  std::array<double, drivers::kMaxJoints> joint_measured{};
  std::uint32_t effort_known = 0;
  // The joint that the latched motor_reversed or effort_mismatch is about, 1 for the first; 0 is
  // none. Not hashed, `faults` is.
  std::uint32_t fault_joint = 0;
  StageTimes stage_ns;  // not hashed
};
static_assert(std::is_trivially_copyable_v<TelemetryRecord>);

// The hash of a record that follows a tick with the hash `previous`. Fields are taken in order as
// 64-bit words (doubles by their bits, every NaN alike); each word w turns h into (h ^ w) *
// 0x9E3779B97F4A7C15, then h ^ (h >> 32).
std::uint64_t state_hash(const TelemetryRecord& record, std::uint64_t previous);

}  // namespace tactus::firmware
