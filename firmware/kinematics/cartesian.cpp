#include "firmware/kinematics/cartesian.h"

namespace tactus::firmware {

void check_geometry(RangeCheck& check, const CartesianGeometry& g) {
  for (const double mass_kg : g.carried_kg) {
    check_mass(check, "mechanism.carried_kg", mass_kg);
  }
}

std::span<const drivers::Binding<CartesianGeometry>> Cartesian::keys() {
  static constexpr std::array kKeys{
      drivers::bind<&CartesianGeometry::carried_kg>("carried_kg", "kg")};
  return kKeys;
}

}  // namespace tactus::firmware
