// The field of a formula on the plane of a picture, and the lines on which it has a value.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "host_tools/plot/tick_view.h"
#include "rendering/surface/implicit_surface.h"

namespace tactus::host {

// Values at the middles of a picture's pixels, rows from the bottom up.
struct FieldGrid {
  // The picture's window, mm.
  Window window;
  std::size_t columns = 0;
  std::size_t rows = 0;
  std::vector<double> values;

  [[nodiscard]] double at(std::size_t column, std::size_t row) const {
    return values[row * columns + column];
  }
  // Returns the middle of a pixel, mm.
  [[nodiscard]] PlanePoint middle(std::size_t column, std::size_t row) const {
    return {.right = window.lower.right + window.width() * (static_cast<double>(column) + 0.5) /
                                              static_cast<double>(columns),
            .up = window.lower.up +
                  window.height() * (static_cast<double>(row) + 0.5) / static_cast<double>(rows)};
  }
};

// Returns f of the formula on the view's plane, in the formula's own unit; not a number outside its
// bounds. The object is where the scene gives it.
FieldGrid sample_field(const rendering::ImplicitSurface& surface, const TickView& view,
                       const Window& window, std::size_t pixels);

// Returns the height above the surface to first order, f / |grad f| in metres of the world, in the
// same manner; infinite where the gradient is zero.
FieldGrid sample_height(const rendering::ImplicitSurface& surface, const TickView& view,
                        const Window& window, std::size_t pixels);

// Returns the lines on which the grid has the level, as pieces within the squares of four
// neighbours, mm. A value between two neighbours is interpolated.
std::vector<std::array<PlanePoint, 2>> contour_of(const FieldGrid& grid, double level);

}  // namespace tactus::host
