#include "firmware/kinematics/paddle.h"

namespace tactus::firmware {

void check_geometry(RangeCheck& check, const PaddleGeometry& g) {
  check_link(check, "mechanism.handle_radius_m", g.handle_radius_m);
  check_weight(check, {"mechanism.paddle.mass_kg", "mechanism.paddle.centre_m"}, g.paddle);
}

std::span<const drivers::Binding<PaddleGeometry>> Paddle::keys() {
  using G = PaddleGeometry;
  static constexpr std::array kKeys{
      drivers::bind<&G::handle_radius_m>("handle_radius_m", "m"),
      drivers::bind<&G::paddle, &LinkWeight::mass_kg>("paddle_kg", "kg"),
      drivers::bind<&G::paddle, &LinkWeight::centre_m>("paddle_centre_m", "m"),
  };
  return kKeys;
}

}  // namespace tactus::firmware
