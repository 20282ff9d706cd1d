#include "drivers/haply_serial/registration.h"

namespace tactus::drivers::haply {

std::span<const Binding<HaplyConnection>> connection_keys() {
  using C = HaplyConnection;
  using H = HaplyConfig;
  static constexpr std::array kKeys{
      bind<&C::port>("port"),
      bind<&C::haply, &H::device_id>("device_id"),
      bind<&C::haply, &H::torque_limit_Nm>("torque_limit_Nm", "Nm"),
      bind<&C::haply, &H::velocity_cutoff_Hz>("velocity_cutoff_hz", "hz"),
      bind<&C::haply, &H::fastest_rad_per_s>("fastest_rad_per_s", "rad_per_s"),
      bind<&C::haply, &H::home_tolerance_rad>("home_tolerance_rad", "rad"),
      bind<&C::haply, &H::unproven_watchdog>("unproven_watchdog"),
  };
  return kKeys;
}

Checked check(const HaplyConnection& connection) {
  return is_absolute_path(connection.port)
             ? Checked{}
             : std::unexpected(FieldError{
                   "port", "must be the path of a serial port from the root on, \"/dev/ttyACM0\""});
}

std::string_view shared_key(const HaplyConnection& one, const HaplyConnection& other) {
  return one.port == other.port ? "port" : "";
}

std::span<const Binding<HaplyAxis>> keys() {
  static constexpr std::array kKeys{bind<&HaplyAxis::number>("number")};
  return kKeys;
}

Checked check(const HaplyAxis& axis, const HaplyConnection& connection) {
  return axis.number < connection.haply.axes
             ? Checked{}
             : std::unexpected(FieldError{"number", "must be 0 or 1"});
}

void stand_at(HaplyConnection& connection, const HaplyAxis& axis, double home_rad) {
  connection.haply.axis[axis.number].home_rad = home_rad;
}

}  // namespace tactus::drivers::haply
