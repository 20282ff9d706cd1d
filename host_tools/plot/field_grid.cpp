#include "host_tools/plot/field_grid.h"

#include <cmath>
#include <limits>

namespace tactus::host {
namespace {

// Fills a square grid with what `value_at` returns for a point of the object's frame.
template <class ValueAt>
FieldGrid sample_grid(const rendering::ImplicitSurface& surface, const TickView& view,
                      const Window& window, std::size_t pixels, const ValueAt& value_at) {
  FieldGrid grid{.window = window, .columns = pixels, .rows = pixels, .values = {}};
  grid.values.reserve(pixels * pixels);
  for (std::size_t row = 0; row < pixels; ++row) {
    for (std::size_t column = 0; column < pixels; ++column) {
      const Vec3 p_O = surface.to_object(view.world(grid.middle(column, row)));
      grid.values.push_back(surface.bounds_O.contains(p_O)
                                ? value_at(p_O)
                                : std::numeric_limits<double>::quiet_NaN());
    }
  }
  return grid;
}

}  // namespace

FieldGrid sample_field(const rendering::ImplicitSurface& surface, const TickView& view,
                       const Window& window, std::size_t pixels) {
  return sample_grid(surface, view, window, pixels,
                     [&](const Vec3& p_O) { return rendering::evaluate(surface.formula, p_O); });
}

FieldGrid sample_height(const rendering::ImplicitSurface& surface, const TickView& view,
                        const Window& window, std::size_t pixels) {
  return sample_grid(surface, view, window, pixels, [&](const Vec3& p_O) {
    const rendering::ValueAndGradient here = rendering::evaluate_gradient(surface.formula, p_O);
    return surface.scale_m * here.value / here.gradient.norm();
  });
}

std::vector<std::array<PlanePoint, 2>> contour_of(const FieldGrid& grid, double level) {
  constexpr std::array<std::array<std::size_t, 2>, 4> kCorners{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  std::vector<std::array<PlanePoint, 2>> pieces;
  for (std::size_t row = 0; row + 1 < grid.rows; ++row) {
    for (std::size_t column = 0; column + 1 < grid.columns; ++column) {
      std::array<PlanePoint, 4> ends;
      std::size_t count = 0;
      for (std::size_t k = 0; k < 4; ++k) {
        const auto [c, r] = kCorners[k];
        const auto [next_c, next_r] = kCorners[(k + 1) % 4];
        const double here = grid.at(column + c, row + r) - level;
        const double next = grid.at(column + next_c, row + next_r) - level;
        if (std::isfinite(here) && std::isfinite(next) && (here < 0.0) != (next < 0.0)) {
          const double share = here / (here - next);
          const PlanePoint a = grid.middle(column + c, row + r);
          const PlanePoint b = grid.middle(column + next_c, row + next_r);
          ends[count++] = {.right = a.right + share * (b.right - a.right),
                           .up = a.up + share * (b.up - a.up)};
        }
      }
      // Four crossings are those of a saddle, and may be joined in either manner.
      for (std::size_t k = 0; k + 1 < count; k += 2) {
        pieces.push_back({ends[k], ends[k + 1]});
      }
    }
  }
  return pieces;
}

}  // namespace tactus::host
