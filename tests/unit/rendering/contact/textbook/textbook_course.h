// A textbook's proxy over one shape, for tests.
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <utility>
#include <vector>

#include "rendering/contact/textbook/textbook_proxy.h"
#include "tests/support/brute_force.h"
#include "tests/support/shapes.h"
#include "tests/support/solid.h"

namespace tactus::testing {

inline constexpr double kPushOut_m = 1e-6;
// Vertices are floats: planes of some centimetres are as exact as this.
inline constexpr double kFloatRounding_m = 5e-9;
inline constexpr std::array kAllRules{
    rendering::TextbookRule::one_plane, rendering::TextbookRule::three_sub_goals,
    rendering::TextbookRule::three_step, rendering::TextbookRule::one_step};

// A plate with its front at y = 0 exactly.
inline Shape textbook_plate() {
  constexpr double kThickness_m = 0.03125;
  return moved(box({0.2, kThickness_m, 0.1}), {0.0, -0.5 * kThickness_m, 0.0});
}

class TextbookCourse {
 public:
  TextbookCourse(Shape shape, rendering::Sides sides, rendering::TextbookRule rule,
                 double push_out_m, const rendering::Material& material, const Vec3& start)
      : solid_(std::move(shape), sides, material),
        corners_(corners_of(solid_.shape())),
        rule_(rule),
        push_out_m_(push_out_m) {
    proxy.place(start);
  }

  rendering::TextbookRest move(const Vec3& tool) {
    constexpr std::size_t kNoLimit = 1'000'000;
    return move(tool, kNoLimit);
  }
  rendering::TextbookRest move(const Vec3& tool, std::size_t most_visits) {
    return proxy.advance(rule_,
                         {.mesh = solid_.object().mesh,
                          .sides = solid_.object().sides,
                          .material = solid_.object().material,
                          .push_out_m = push_out_m_},
                         tool, most_visits);
  }

  // Returns the distance of p from the surface by a search through all triangles, m.
  [[nodiscard]] double distance(const Vec3& p) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Corners& t : corners_) {
      nearest = std::min(nearest, (nearest_point(t, p) - p).norm());
    }
    return nearest;
  }

  // Returns the largest height of p over the planes of all triangles, m: the distance from a convex
  // solid or less, and below 0 only inside.
  [[nodiscard]] double height_over_convex(const Vec3& p) const {
    double highest = -std::numeric_limits<double>::infinity();
    for (const Corners& t : corners_) {
      highest = std::max(highest, (t.b - t.a).cross(t.c - t.a).normalized().dot(p - t.a));
    }
    return highest;
  }

  [[nodiscard]] const Shape& shape() const { return solid_.shape(); }

  rendering::TextbookProxy proxy;

 private:
  Solid solid_;
  std::vector<Corners> corners_;
  rendering::TextbookRule rule_;
  double push_out_m_;
};

}  // namespace tactus::testing
