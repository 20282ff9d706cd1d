#include "drivers/odrive_can/odrive_can.h"

#include <algorithm>
#include <array>

#include "drivers/common/seconds.h"
#include "drivers/common/torque_clamp.h"

namespace tactus::drivers {

namespace {

using odrive::AxisState;
using odrive::Command;
using odrive::Generation;

// A drive that has not sent its version in this time has firmware 0.5.
constexpr double kProbe_s = 0.1;
constexpr double kProbeAgain_s = 0.02;
constexpr double kSettleAgain_s = 0.1;
constexpr double kArmAgain_s = 0.3;
constexpr double kStopAgain_s = 0.01;
constexpr double kExplainAgain_s = 0.02;
// Offsets the questions for torque, so that drives with consecutive numbers are asked in different
// ticks.
constexpr hal::TimeNs kPollSpread_ns = 2'000'000;
constexpr std::uint8_t kPollSpread = 5;

// The values that are asked for in turn. Errors come first; after a fault only they are asked for.
constexpr std::array kPolled_0_5 = {Command::get_motor_error, Command::get_encoder_error,
                                    Command::get_controller_error, Command::get_bus,
                                    Command::get_iq};
constexpr std::size_t kErrors_0_5 = 3;
constexpr std::array kPolled_0_6 = {Command::get_error, Command::get_temperature, Command::get_bus,
                                    Command::get_iq};
constexpr std::size_t kErrors_0_6 = 1;

}  // namespace

ODriveCan::ODriveCan(const ODriveConfig& config)
    : config_(config),
      encoder_({.max_speed_rad_per_s = config.max_speed_rad_per_s,
                .margin_rad = config.jump_margin_rad}) {}

std::size_t ODriveCan::filters(std::span<hal::CanFilter> filters) const {
  constexpr std::uint32_t kAnyCommand = 0x1F;
  filters[0] = hal::CanFilter::standard(odrive::frame_id(config_.node_id, Command{}));
  filters[0].mask &= ~kAnyCommand;
  return 1;
}

void ODriveCan::start(hal::TimeNs now_ns) {
  known_ = {};
  begin(now_ns);
}

void ODriveCan::clear_faults(hal::TimeNs now_ns) {
  if (stage_.phase == Phase::failed) {
    begin(now_ns);
  }
}

// A position that is followed stays so.
void ODriveCan::begin(hal::TimeNs now_ns) {
  if (!known_.is_followed) {
    sample_ = {};
    encoder_.reset();
  }
  sample_.status = kDeviceNotReady;
  sample_.has_torque = false;
  faults_.clear();
  session_ = {};
  enter(Phase::listening, now_ns);
}

void ODriveCan::enter(Phase phase, hal::TimeNs now_ns) {
  stage_ = {.phase = phase, .begun_ns = now_ns};
  if (phase == Phase::up) {
    sample_.status = kDeviceOk;
    polls_.polled_ns = now_ns;
    polls_.torque_polled_ns = now_ns + kPollSpread_ns * (config_.node_id % kPollSpread);
    known_.is_followed = true;
  } else {
    sample_.has_torque = false;
  }
}

void ODriveCan::request(hal::TimeNs now_ns, CanOutbox& outbox) {
  watch_deadlines(now_ns);
  const bool is_there = stage_.phase == Phase::settling || stage_.phase == Phase::arming ||
                        stage_.phase == Phase::up || known_.is_followed;
  if (is_there && stage_.phase != Phase::off && config_.estimates == ODriveEstimates::requested) {
    outbox.add(
        odrive::request(config_.node_id, Command::get_estimates, config_.ask_by_remote_frame));
  }
}

void ODriveCan::command(hal::TimeNs now_ns, const AxisCommand& command, CanOutbox& outbox) {
  watch_deadlines(now_ns);
  switch_power(command.power_off, now_ns);
  // Every frame to the node may feed its watchdog, so none is sent.
  if (stage_.phase == Phase::off || stage_.phase == Phase::proving) {
    return;
  }
  // A drive that has not been heard gets nothing more, since frames that nobody acknowledges would
  // fill the queue.
  const bool speaks = stage_.phase != Phase::listening || !stage_.repeats.has_sent();
  if (speaks) {
    send_torque(
        stage_.phase == Phase::up ? clamped_torque_Nm(command, config_.max_torque_Nm) : 0.0F,
        outbox);
  }
  send_of_phase(now_ns, outbox);
  if (!poll_torque(now_ns, outbox)) {  // one question a tick, to spare the bus
    poll(now_ns, outbox);
  }
}

// Keeps the axis out of closed loop while the power is to be off.
void ODriveCan::switch_power(bool power_off, hal::TimeNs now_ns) {
  const bool has_power =
      stage_.phase == Phase::arming || stage_.phase == Phase::proving || stage_.phase == Phase::up;
  if (power_off && has_power) {
    enter(Phase::resting, now_ns);
  } else if (!power_off && stage_.phase == Phase::resting) {
    sample_.status = kDeviceNotReady;
    enter(Phase::settling, now_ns);
  }
}

// Sends the frames of the phase other than the torque.
void ODriveCan::send_of_phase(hal::TimeNs now_ns, CanOutbox& outbox) {
  switch (stage_.phase) {
    case Phase::listening:
      if (is_time_to_send(config_.bring_up_s, now_ns)) {
        send_state(AxisState::idle, outbox);
      }
      return;
    case Phase::probing:
      probe(now_ns, outbox);
      return;
    case Phase::settling:
      settle(now_ns, outbox);
      return;
    case Phase::arming:
      if (is_time_to_send(kArmAgain_s, now_ns)) {
        send_state(AxisState::closed_loop, outbox);
      }
      return;
    case Phase::resting:
    case Phase::failed:
      if (is_time_to_send(kStopAgain_s, now_ns)) {
        send_state(AxisState::idle, outbox);
      }
      return;
    default:
      return;
  }
}

void ODriveCan::shutdown(CanOutbox& outbox) {
  send_torque(0.0F, outbox);
  send_state(AxisState::idle, outbox);
  stage_.phase = Phase::off;
  sample_.status |= kDeviceNotReady;
}

void ODriveCan::probe(hal::TimeNs now_ns, CanOutbox& outbox) {
  if (has_passed(kProbe_s, stage_.begun_ns, now_ns)) {
    session_.generation = Generation::v0_5;
    enter(Phase::settling, now_ns);
    return;
  }
  if (is_time_to_send(kProbeAgain_s, now_ns)) {
    outbox.add(odrive::request(config_.node_id, Command::get_version, config_.ask_by_remote_frame));
  }
}

void ODriveCan::settle(hal::TimeNs now_ns, CanOutbox& outbox) {
  if (!is_time_to_send(kSettleAgain_s, now_ns)) {
    return;
  }
  send_state(AxisState::idle, outbox);
  outbox.add(odrive::clear_errors(config_.node_id));
  outbox.add(odrive::set_torque_mode(config_.node_id));
  if (config_.drive_speed_limit_rad_per_s > 0.0) {
    outbox.add(odrive::set_limits(config_.node_id, config_.drive_speed_limit_rad_per_s,
                                  config_.drive_current_limit_A));
  }
}

void ODriveCan::poll(hal::TimeNs now_ns, CanOutbox& outbox) {
  const bool explains = stage_.phase == Phase::failed && session_.wants_explanation;
  const double period_s = explains ? kExplainAgain_s : config_.poll_period_s;
  if ((stage_.phase != Phase::up && !explains) || period_s <= 0.0 ||
      !has_passed(period_s, polls_.polled_ns, now_ns)) {
    return;
  }
  polls_.polled_ns = now_ns;
  std::span<const Command> polled = kPolled_0_6;
  std::size_t errors = kErrors_0_6;
  if (session_.generation == Generation::v0_5) {
    polled = kPolled_0_5;
    errors = kErrors_0_5;
  }
  polls_.next %= explains ? errors : polled.size();
  outbox.add(odrive::request(config_.node_id, polled[polls_.next], config_.ask_by_remote_frame));
  ++polls_.next;
}

bool ODriveCan::poll_torque(hal::TimeNs now_ns, CanOutbox& outbox) {
  const bool is_0_6 = session_.generation == Generation::v0_6;
  const bool is_known = is_0_6 || config_.torque_constant_Nm_per_A > 0.0;
  if (stage_.phase != Phase::up || !is_known || config_.torque_period_s <= 0.0 ||
      !has_passed(config_.torque_period_s, polls_.torque_polled_ns, now_ns)) {
    return false;
  }
  polls_.torque_polled_ns = now_ns;
  return outbox.add(odrive::request(config_.node_id,
                                    is_0_6 ? Command::get_torques : Command::get_iq,
                                    config_.ask_by_remote_frame));
}

bool ODriveCan::is_time_to_send(double period_s, hal::TimeNs now_ns) {
  if (!stage_.repeats.is_due(period_s, now_ns)) {
    return false;
  }
  if (!stage_.repeats.has_sent()) {
    stage_.first_sent_ns = now_ns;
  }
  stage_.repeats.sent(now_ns);
  return true;
}

bool ODriveCan::was_sent_before(hal::TimeNs time_ns) const {
  return stage_.repeats.has_sent() && time_ns > stage_.first_sent_ns;
}

void ODriveCan::send_torque(float torque_Nm, CanOutbox& outbox) const {
  outbox.add(odrive::set_input_torque(config_.node_id, torque_Nm));
}

void ODriveCan::send_state(AxisState state, CanOutbox& outbox) const {
  outbox.add(odrive::set_axis_state(config_.node_id, state));
}

}  // namespace tactus::drivers
