#include "drivers/falcon_usb/registration.h"

namespace tactus::drivers::falcon {

std::span<const Binding<FalconConnection>> connection_keys() {
  using C = FalconConnection;
  using F = FalconConfig;
  static constexpr std::array kKeys{
      bind<&C::firmware_file>("firmware_file"),
      bind<&C::serial>("serial"),
      bind<&C::falcon, &F::motor_units_per_Nm>("motor_units_per_Nm", "per_Nm"),
      bind<&C::falcon, &F::torque_limit_Nm>("torque_limit_Nm", "Nm"),
      bind<&C::falcon, &F::velocity_cutoff_Hz>("velocity_cutoff_hz", "hz"),
      bind<&C::falcon, &F::fastest_rad_per_s>("fastest_rad_per_s", "rad_per_s"),
      bind<&C::falcon, &F::unproven_watchdog>("unproven_watchdog"),
  };
  return kKeys;
}

std::span<const Binding<FalconAxis>> keys() {
  static constexpr std::array kKeys{bind<&FalconAxis::number>("number")};
  return kKeys;
}

Checked check(const FalconAxis& axis, const FalconConnection& /*connection*/) {
  return axis.number < kFalconArms ? Checked{}
                                   : std::unexpected(FieldError{"number", "must be 0, 1 or 2"});
}

std::string_view shared_key(const FalconConnection& one, const FalconConnection& other) {
  const bool differ = !one.serial.empty() && !other.serial.empty() && one.serial != other.serial;
  return differ ? "" : "serial";
}

}  // namespace tactus::drivers::falcon
