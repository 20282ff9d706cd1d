// The second half of a tick of GpioAxis: it converts a command to duty and lines.
#include <algorithm>
#include <cmath>

#include "drivers/gpio_axis/gpio_axis.h"

namespace tactus::drivers {

void GpioAxis::write(std::span<const AxisCommand> commands) {
  if (!running_) {
    return;
  }
  const hal::TimeNs now_ns = hardware_.clock->now_ns();
  output_.written_ns = now_ns;
  if (fault_.trouble != GpioAxisTrouble::none || !commands[0].enable) {
    cut_power();
    return;
  }
  if (!output_.powered) {
    power_up(now_ns);
  }
  output_.torque_Nm = allowed_torque(commands[0], now_ns);
  apply(bridge_.drive(output_.torque_Nm, now_ns));
  beat();
  if (fault_.trouble != GpioAxisTrouble::none) {
    cut_power();
  }
}

void GpioAxis::power_up(hal::TimeNs now_ns) {
  output_.cut = false;
  output_.powered = true;
  output_.powered_since_ns = now_ns;
  if (set(AxisLine::enable, true)) {
    set(AxisLine::brake_release, true);
  }
}

double GpioAxis::allowed_torque(const AxisCommand& command, hal::TimeNs now_ns) const {
  const double most_Nm = config_.bridge.max_torque_Nm;
  const hal::TimeNs ramp_ns = hal::TimeNs{config_.torque_ramp_ms} * 1'000'000;
  const auto since_ns = now_ns - output_.powered_since_ns;
  const double part =
      since_ns >= ramp_ns ? 1.0 : static_cast<double>(since_ns) / static_cast<double>(ramp_ns);
  const double wanted_Nm = std::isfinite(command.torque_Nm) ? command.torque_Nm : 0.0;
  return safety_.within_limits(std::clamp(wanted_Nm, -part * most_Nm, part * most_Nm));
}

void GpioAxis::apply(const BridgeOutput& output) {
  if (output.reverse != output_.reverse) {
    if (!set_duty(0) || !set(AxisLine::direction, output.reverse)) {
      return;
    }
    output_.reverse = output.reverse;
  }
  set_duty(output.duty_ns);
}

void GpioAxis::beat() {
  if (lines_.is_connected(AxisLine::heartbeat)) {
    output_.heartbeat = !output_.heartbeat;
    set(AxisLine::heartbeat, output_.heartbeat);
  }
}

// Cuts the power. The bridge's enable goes first: it stops both kinds of bridge with one call.
// Calls that fail are repeated in the next tick.
void GpioAxis::cut_power() {
  output_.powered = false;
  output_.torque_Nm = 0.0;
  if (output_.cut) {
    return;
  }
  const bool lines_off =
      did(lines_.switch_off(), GpioAxisTrouble::lines_gone, GpioAxisTrouble::lines_fail);
  output_.heartbeat = false;
  const bool duty_off = set_duty(bridge_.idle(hardware_.clock->now_ns()).duty_ns);
  output_.cut = lines_off && duty_off;
}

bool GpioAxis::set(AxisLine line, bool active) {
  return did(lines_.set(line, active), GpioAxisTrouble::lines_gone, GpioAxisTrouble::lines_fail);
}

bool GpioAxis::set_duty(hal::TimeNs duty_ns) {
  return hardware_.pwm->settings().duty_ns == duty_ns ||
         did(hardware_.pwm->set_duty_ns(duty_ns), GpioAxisTrouble::pwm_gone,
             GpioAxisTrouble::pwm_fails);
}

}  // namespace tactus::drivers
