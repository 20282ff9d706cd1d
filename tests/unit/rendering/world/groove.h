// A groove between two planes, for tests of friction in a corner.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <memory>

#include <Eigen/Geometry>

#include "rendering/friction/friction_parameters.h"
#include "rendering/world/world.h"

namespace tactus::testing {

// The tick of a groove's world, and the stiffness of bristles in it.
inline constexpr double kGrooveTick_s = 1e-3;
inline constexpr double kGrooveBristle_N_per_m = 400.0;

// A side of a groove along z.
struct Side {
  double stiffness_N_per_m = 0.0;
  rendering::FrictionParameters friction;
};

// A groove of two planes, each at `half_rad` from the plane x = 0, for a tool that is a point.
class Groove {
 public:
  Groove(double half_rad, const Side& left, const Side& right)
      : normals_{Vec3(std::cos(half_rad), std::sin(half_rad), 0.0),
                 Vec3(-std::cos(half_rad), std::sin(half_rad), 0.0)} {
    const std::array sides{left, right};
    for (std::size_t i = 0; i < sides.size(); ++i) {
      objects_[i] = {.surface = rendering::SurfaceKind::primitive,
                     .primitive = {.kind = rendering::PrimitiveKind::plane},
                     .material = {.stiffness_N_per_m = sides[i].stiffness_N_per_m,
                                  .friction = sides[i].friction}};
      Mat3& rotation = objects_[i].primitive.X_WO.rotation;
      rotation.col(1) = normals_[i];
      rotation.col(2) = Vec3::UnitZ();
      rotation.col(0) = normals_[i].cross(Vec3::UnitZ());
    }
    EXPECT_TRUE(world_->set_scene(objects_, {.tool_radius_m = 0.0}));
    EXPECT_TRUE(world_->set_tick(kGrooveTick_s));
    world_->touch({.p_W = {0.0, 0.01, 0.0}});
  }

  rendering::Touch touch(const Vec3& tool) { return world_->touch({.p_W = tool}); }

  // Returns the pressures of a tool at (x, -depth), m: depth and x are made of the two normals.
  [[nodiscard]] std::array<double, 2> pressures_m(double x, double depth) const {
    const Vec3& n = normals_[0];
    return {0.5 * (depth / n.y() - x / n.x()), 0.5 * (depth / n.y() + x / n.x())};
  }

 private:
  std::array<Vec3, 2> normals_;
  std::array<rendering::Object, 2> objects_;
  std::unique_ptr<rendering::World> world_ = std::make_unique<rendering::World>();
};

}  // namespace tactus::testing
