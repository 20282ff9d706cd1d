// The part of MoteusCanFd that takes the servo's replies.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "drivers/common/seconds.h"
#include "drivers/moteus_canfd/moteus_canfd.h"
#include "drivers/moteus_canfd/moteus_errors.h"

namespace tactus::drivers {

namespace {

// Stands for a missing value. encoder_check refuses it as it refuses a NaN from the servo.
constexpr double kMissingValue = std::numeric_limits<double>::quiet_NaN();

constexpr std::uint32_t kServoMoved = kDeviceEncoderFault | kDeviceReferenceLost;
constexpr std::uint32_t kServoRestarted = kDeviceDriveFault | kDeviceReferenceLost;

// Returns the status bits of a fault code. After a fault of supply or encoder the position may
// count from another zero.
std::uint32_t status_of_fault(std::uint8_t code) {
  constexpr std::array<std::uint8_t, 6> kSupplyOrEncoder = {33, 35, 40, 42, 43, 44};
  return std::ranges::find(kSupplyOrEncoder, code) != kSupplyOrEncoder.end()
             ? kServoRestarted
             : std::uint32_t{kDeviceDriveFault};
}

}  // namespace

void MoteusCanFd::take(const hal::CanReceived& received) {
  const hal::CanFrame& frame = received.frame;
  if (received.kind == hal::CanReceived::Kind::frame && !frame.remote &&
      frame.id == moteus::reply_id(address_) && stage_.phase != Phase::off) {
    take_reply(moteus::read_reply(frame.bytes()), received.time_ns);
  }
}

void MoteusCanFd::take_reply(const moteus::Reply& reply, hal::TimeNs time_ns) {
  heard_.has_replied = true;
  heard_.reply_ns = time_ns;
  if (reply.refused_register) {
    fail(kDeviceDriveFault, {"the servo refuses a register that this driver uses",
                             "update the servo's firmware, then reset", *reply.refused_register});
    return;
  }
  if (!reply.mode || !reply.position_rad || !reply.velocity_rad_per_s) {
    ++readings_.malformed;
    return;
  }
  const std::uint8_t told = reply.fault.value_or(0);
  readings_.limit = moteus::is_limit(told) ? told : std::uint8_t{0};
  readings_.voltage_V = reply.voltage_V.value_or(readings_.voltage_V);
  readings_.temperature_C = reply.temperature_C.value_or(readings_.temperature_C);
  take_home_state(reply.home_state);
  take_mode(*reply.mode, moteus::is_limit(told) ? std::uint8_t{0} : told, time_ns);
  take_position(reply, time_ns);
}

// A servo whose home state falls has restarted.
void MoteusCanFd::take_home_state(std::optional<std::uint8_t> home_state) {
  if (!home_state) {
    return;
  }
  if (known_.is_followed && *home_state < readings_.home_state) {
    fail(kServoRestarted,
         {"the servo restarted by itself: it knows less of its position than before",
          "check its supply, then reset and home", *home_state});
  }
  readings_.home_state = *home_state;
  if (config_.absolute_output && *home_state != moteus::kHomeOutput) {
    fail(kServoRestarted,
         {"the servo knows no absolute position of its output, only its rotor's at most",
          "home the joint instead of reference absolute, or fit an output encoder and set "
          "motor_position.sources and output in tview; then reset",
          *home_state});
  }
}

void MoteusCanFd::take_mode(std::uint8_t mode, std::uint8_t fault, hal::TimeNs time_ns) {
  heard_.last_fault = fault;
  const auto told = static_cast<moteus::Mode>(mode);
  if (known_.is_followed && fault != 0 && status_of_fault(fault) == kServoRestarted) {
    fail(kServoRestarted, moteus::fault_trouble(fault));
  }
  switch (stage_.phase) {
    case Phase::stopping:
      if (told == moteus::Mode::stopped && fault == 0) {
        enter(Phase::starting, time_ns);
      }
      return;
    case Phase::starting:
    case Phase::up:
      take_mode_under_torque(told, fault, time_ns);
      return;
    case Phase::proving:
      take_proof(told, fault, time_ns);
      return;
    default:
      return;
  }
}

void MoteusCanFd::take_mode_under_torque(moteus::Mode mode, std::uint8_t fault,
                                         hal::TimeNs time_ns) {
  if (mode == moteus::Mode::fault || fault != 0) {
    fail(status_of_fault(fault), moteus::fault_trouble(fault));
  } else if (mode == moteus::Mode::timeout) {
    fail(kDeviceDriveFault, {"the servo's watchdog expired: commands came too late",
                             "check the bus's cable and the host's load, then reset",
                             static_cast<std::uint32_t>(mode)});
  } else if (stage_.phase == Phase::up && mode != moteus::Mode::position) {
    fail(mode == moteus::Mode::stopped ? kServoRestarted : std::uint32_t{kDeviceDriveFault},
         {"the servo left torque control by itself, as one that restarts does",
          "check its supply and who else commands it, then reset and home",
          static_cast<std::uint32_t>(mode)});
  } else if (stage_.phase == Phase::starting && mode == moteus::Mode::position &&
             encoder_.is_trusted() &&
             !has_passed(config_.reply_stale_s, heard_.position_ns, time_ns)) {
    enter(known_.is_proven || config_.unproven_watchdog ? Phase::up : Phase::proving, time_ns);
  }
}

// Takes a reply during the proof. The silence counts from the last torque frame.
void MoteusCanFd::take_proof(moteus::Mode mode, std::uint8_t fault, hal::TimeNs time_ns) {
  if (mode == moteus::Mode::fault || fault != 0) {
    fail(status_of_fault(fault), moteus::fault_trouble(fault));
  } else if (mode == moteus::Mode::timeout) {
    known_.is_proven = true;
    enter(Phase::stopping, time_ns);
  } else if (mode != moteus::Mode::position) {
    fail(kDeviceDriveFault,
         {"the servo left torque control while its watchdog was proven",
          "find out who else commands it, then reset", static_cast<std::uint32_t>(mode)});
  }
}

// The position is watched in every phase. A jump while it is followed loses the reference.
void MoteusCanFd::take_position(const moteus::Reply& reply, hal::TimeNs time_ns) {
  const double position_rad = reply.position_rad.value_or(kMissingValue);
  const double velocity_rad_per_s = reply.velocity_rad_per_s.value_or(kMissingValue);
  const EncoderVerdict verdict = encoder_.check(position_rad, velocity_rad_per_s, time_ns);
  if (verdict != EncoderVerdict::good) {
    if (known_.is_followed) {
      fail(kServoMoved, trouble_of(verdict));
    }
    encoder_.reset();
    return;
  }
  heard_.position_ns = time_ns;
  if (stage_.phase == Phase::failed) {
    return;
  }
  sample_.position_rad = position_rad;
  sample_.velocity_rad_per_s = velocity_rad_per_s;
  if (reply.torque_Nm && std::isfinite(*reply.torque_Nm)) {
    sample_.torque_Nm = *reply.torque_Nm;
    sample_.has_torque = true;
    sample_.torque_time_ns = time_ns;
  }
  sample_.time_ns = time_ns;
  sample_.status &= ~std::uint32_t{kDeviceStale};
}

}  // namespace tactus::drivers
