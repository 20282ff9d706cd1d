#include "host_tools/graph/label_places.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tactus::host {
namespace {

// Returns true if the line crosses the box: the part of it between the box's sides is not empty.
bool crosses(const PixelLine& line, const LabelBox& box) {
  double first = 0.0;
  double last = 1.0;
  const auto cut = [&](double from, double to, double middle, double half) {
    const double step = to - from;
    const double low = middle - half - from;
    const double high = middle + half - from;
    if (step == 0.0) {
      if (low > 0.0 || high < 0.0) {
        last = -1.0;
      }
      return;
    }
    first = std::max(first, std::min(low / step, high / step));
    last = std::min(last, std::max(low / step, high / step));
  };
  cut(line.first.right, line.second.right, box.middle.right, 0.5 * box.width);
  cut(line.first.up, line.second.up, box.middle.up, 0.5 * box.height);
  return first <= last;
}

}  // namespace

bool LabelPlaces::is_free_of_labels(const LabelBox& box) const {
  return std::ranges::none_of(boxes_, [&](const LabelBox& other) {
    return std::abs(box.middle.right - other.middle.right) < 0.5 * (box.width + other.width) &&
           std::abs(box.middle.up - other.middle.up) < 0.5 * (box.height + other.height);
  });
}

bool LabelPlaces::is_free_of_lines(const LabelBox& box) const {
  return std::ranges::none_of(lines_, [&](const PixelLine& line) { return crosses(line, box); });
}

std::optional<PlanePoint> LabelPlaces::take_beside(const PlanePoint& point, double width,
                                                   double height) {
  constexpr int kDirections = 8;
  for (const double gap : {4.0, 9.0, 14.0}) {
    for (int i = 0; i < kDirections; ++i) {
      const double angle = (i + 1) * 2.0 * std::numbers::pi / kDirections;
      const LabelBox box{.middle = {.right = point.right + (0.5 * width + gap) * std::cos(angle),
                                    .up = point.up + (0.5 * height + gap) * std::sin(angle)},
                         .width = width,
                         .height = height};
      if (is_free_of_labels(box) && is_free_of_lines(box)) {
        take(box);
        return box.middle;
      }
    }
  }
  return std::nullopt;
}

}  // namespace tactus::host
