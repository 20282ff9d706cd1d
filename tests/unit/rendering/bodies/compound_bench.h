// Bodies of several convex parts for tests, and their mass properties in closed form.
#pragma once

#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "rendering/surface/primitive.h"
#include "tests/unit/rendering/bodies/body_bench.h"

namespace tactus::rendering {

inline Primitive box_part(const Vec3& center, const Vec3& half) {
  return {.kind = PrimitiveKind::box,
          .X_WO = {.translation = center},
          .dimensions_m = {half.x(), half.y(), half.z()}};
}
inline Primitive ball_part(const Vec3& center, double radius) {
  return {.kind = PrimitiveKind::sphere, .X_WO = {.translation = center}, .dimensions_m = {radius}};
}

// Returns the mass properties of boxes that do not overlap, by the parallel axes' theorem.
inline BodyMass mass_of_boxes(std::span<const Primitive> boxes, double density_kg_per_m3) {
  BodyMass sum{.mass_kg = 0.0, .inertia_C = Mat3::Zero()};
  const auto mass_of = [&](const Primitive& box) {
    const auto& d = box.dimensions_m;
    return 8.0 * d[0] * d[1] * d[2] * density_kg_per_m3;
  };
  for (const Primitive& box : boxes) {
    sum.mass_kg += mass_of(box);
    sum.center_O += mass_of(box) * box.X_WO.translation;
  }
  sum.center_O /= sum.mass_kg;
  for (const Primitive& box : boxes) {
    const auto& d = box.dimensions_m;
    const Vec3 arm = box.X_WO.translation - sum.center_O;
    sum.inertia_C += mass_of_box(mass_of(box), Vec3(d[0], d[1], d[2])).inertia_C +
                     mass_of(box) * (arm.squaredNorm() * Mat3::Identity() - arm * arm.transpose());
  }
  return sum;
}

// A round cup about the y axis with its bottom at y = 0: a floor, and walls all round whose inner
// faces touch the inner circle.
struct CupShape {
  static constexpr int kWalls = 12;
  double inner_radius_m = 0.03;
  double wall_m = 0.004;
  double floor_m = 0.005;
  // The height of the walls above the floor.
  double height_m = 0.04;

  // Returns the parts: the floor first, then the walls; the first wall is toward +x. The walls
  // stand a little above the bottom.
  [[nodiscard]] std::vector<Primitive> parts() const {
    constexpr double kRaised_m = 1e-3;
    const double outer_m = inner_radius_m + wall_m;
    std::vector<Primitive> all{
        box_part(Vec3(0.0, 0.5 * floor_m, 0.0), Vec3(outer_m, 0.5 * floor_m, outer_m))};
    const double half_m = 0.5 * (height_m + floor_m - kRaised_m);
    for (int i = 0; i < kWalls; ++i) {
      const Mat3 turn = body_turned(Vec3::UnitY(), 2.0 * std::numbers::pi * i / kWalls);
      const double width_m = outer_m * std::tan(std::numbers::pi / kWalls);
      Primitive wall = box_part(turn * Vec3(inner_radius_m + 0.5 * wall_m, kRaised_m + half_m, 0.0),
                                Vec3(0.5 * wall_m, half_m, width_m));
      wall.X_WO.rotation = turn;
      all.push_back(wall);
    }
    return all;
  }
};

}  // namespace tactus::rendering
