// One formula as a surface in the world, for tests.
#pragma once

#include <string_view>

#include "host_tools/bake/formula/formula_parser.h"
#include "rendering/contact/implicit_tracking.h"
#include "rendering/surface/implicit_surface.h"

namespace tactus::rendering {

class FormulaSurface {
 public:
  explicit FormulaSurface(std::string_view text, double scale_m = 1.0, Sides sides = Sides::one)
      : formula_(host::parse_formula(text)) {
    surface.formula = formula_.view();
    surface.bounds_O = {.lower = Vec3::Constant(-10.0), .upper = Vec3::Constant(10.0)};
    surface.scale_m = scale_m;
    surface.sides = sides;
  }
  FormulaSurface(const FormulaSurface&) = delete;
  FormulaSurface& operator=(const FormulaSurface&) = delete;
  FormulaSurface(FormulaSurface&&) = delete;
  FormulaSurface& operator=(FormulaSurface&&) = delete;
  ~FormulaSurface() = default;

  // f where the proxy is.
  [[nodiscard]] double value_at(const Vec3& p_W) const {
    return evaluate(surface.formula, surface.to_object(p_W));
  }

  ImplicitSurface surface;

 private:
  host::Formula formula_;
};

inline constexpr Material kNoFriction{.stiffness_N_per_m = 1000.0};

constexpr Material rough(double static_coefficient, double dynamic_coefficient) {
  return {.stiffness_N_per_m = 1000.0,
          .friction = cone_friction(static_coefficient, dynamic_coefficient)};
}

}  // namespace tactus::rendering
