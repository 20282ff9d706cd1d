// Corners between surfaces of different stiffness: a slow closed path of the tool gives out
// nothing, whatever the walls are made of. The oracles are the walls' own springs, the work along
// the path, and differences of the potential.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "rendering/contact/corner_spring.h"
#include "rendering/geometry/plane_projection.h"
#include "rendering/world/world.h"
#include "tests/support/materials.h"
#include "tests/support/rows.h"
#include "tests/support/solid.h"

namespace tactus::rendering {
namespace {

using testing::Solid;

constexpr double kCornerTool_m = 0.002;
// The half side of a wall's plate; its ends are far from every path.
constexpr double kPlateHalf_m = 0.05;

// Returns the rotation that takes +y to the normal.
Mat3 facing(const Vec3& normal) {
  const Vec3 x = (std::abs(normal.x()) < 0.8 ? Vec3::UnitX() : Vec3::UnitZ()).eval();
  Mat3 rotation;
  rotation.col(1) = normal;
  rotation.col(2) = x.cross(normal).normalized();
  rotation.col(0) = rotation.col(1).cross(rotation.col(2));
  return rotation;
}

enum class Kind : std::uint8_t { plane, box, mesh };

std::string name_of(Kind kind) {
  switch (kind) {
    case Kind::plane:
      return "plane";
    case Kind::box:
      return "box";
    default:
      return "mesh";
  }
}

struct Wall {
  Vec3 normal;
  double stiffness_N_per_m = 0.0;
  Kind kind = Kind::plane;
};

// Walls through the origin. They keep their meshes.
class Corner {
 public:
  explicit Corner(const std::vector<Wall>& walls) {
    for (const Wall& wall : walls) {
      objects_.push_back(object_of(wall));
    }
    EXPECT_TRUE(world_->set_scene(objects_, {.tool_radius_m = kCornerTool_m}));
  }

  Touch touch(const Vec3& tool) { return world_->touch({.p_W = tool}); }

 private:
  Object object_of(const Wall& wall) {
    const Material material{.stiffness_N_per_m = wall.stiffness_N_per_m};
    const Mat3 rotation = facing(wall.normal);
    if (wall.kind == Kind::mesh) {
      testing::Shape plate{.name = "plate", .closed = false};
      for (const auto& [x, z] : {std::pair{-1, -1}, {-1, 1}, {1, 1}, {1, -1}}) {
        const Vec3 corner = kPlateHalf_m * (rotation * Vec3(x, 0, z));
        plate.vertices.push_back({static_cast<float>(corner.x()), static_cast<float>(corner.y()),
                                  static_cast<float>(corner.z())});
      }
      plate.triangles = {{0, 1, 2}, {0, 2, 3}};
      return meshes_.emplace_back(std::make_unique<Solid>(plate, Sides::one, material))->object();
    }
    Object object{.surface = SurfaceKind::primitive, .material = material};
    object.primitive.X_WO.rotation = rotation;
    if (wall.kind == Kind::box) {
      object.primitive.kind = PrimitiveKind::box;
      object.primitive.dimensions_m = {2.0 * kPlateHalf_m, 0.02, 2.0 * kPlateHalf_m};
      object.primitive.X_WO.translation = -0.01 * wall.normal;
    } else {
      object.primitive.kind = PrimitiveKind::plane;
    }
    return object;
  }

  std::vector<std::unique_ptr<Solid>> meshes_;
  std::vector<Object> objects_;
  std::unique_ptr<World> world_ = std::make_unique<World>();
};

// Returns the energy that a slow round of the closed path gives out, J: the work on the hand. The
// path goes straight from corner to corner, in micrometres.
double given_out_J(Corner& corner, std::span<const Vec3> corners) {
  constexpr double kTravel_m = 1e-6;
  double work_J = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3& from = corners[i];
    const Vec3& to = corners[(i + 1) % corners.size()];
    const int steps = static_cast<int>(std::ceil((to - from).norm() / kTravel_m));
    Vec3 force = corner.touch(from).force_W;
    for (int step = 1; step <= steps; ++step) {
      const Vec3 next = corner.touch(from + (to - from) * step / steps).force_W;
      work_J += (force + next).dot(to - from) / (2.0 * steps);
      force = next;
    }
  }
  return work_J;
}

// Returns the unit vector in the xy plane at an angle from +y, degrees.
Vec3 at_degrees(double angle) {
  const double a = angle * std::numbers::pi / 180.0;
  return {std::sin(a), std::cos(a), 0.0};
}

TEST(CornerOfStiffnesses, WallsAtRightAnglesPushWithTheirOwnSprings) {
  Corner corner({{Vec3::UnitX(), 1000.0}, {Vec3::UnitY(), 200.0}, {Vec3::UnitZ(), 500.0}});
  corner.touch({0.01, 0.01, 0.01});
  const Vec3 depth(0.003, 0.003, 0.001);
  const Touch touch = corner.touch(Vec3::Constant(kCornerTool_m) - depth);
  EXPECT_NEAR(touch.force_W.x(), 3.0, 1e-3);
  EXPECT_NEAR(touch.force_W.y(), 0.6, 1e-3);
  EXPECT_NEAR(touch.force_W.z(), 0.5, 1e-3);
}

TEST(CornerOfStiffnesses, OfWallsInOnePlaceTheFirstIsFelt) {
  for (const double first : {200.0, 1000.0}) {
    Corner corner({{Vec3::UnitY(), first}, {Vec3::UnitY(), 1200.0 - first}});
    corner.touch({0.0, 0.01, 0.0});
    EXPECT_NEAR(corner.touch({0.0, kCornerTool_m - 0.001, 0.0}).force_W.y(), 0.001 * first, 1e-3);
  }
}

// The path of the audit: 3 mm by 3 mm, partly in the corner and partly in the reach of one wall.
TEST(CornerOfStiffnesses, OfTwoGivesNothingOutOnAClosedPath) {
  const std::array kinds{Kind::plane, Kind::box, Kind::mesh};
  for (const Kind first : kinds) {
    for (const Kind second : kinds) {
      for (const double degrees : {60.0, 90.0, 110.0, 135.0}) {
        for (const auto& [hard, soft] : {std::pair{1000.0, 200.0}, {2000.0, 100.0}}) {
          if (!testing::is_taken()) {
            continue;
          }
          Corner corner({{at_degrees(0.0), hard, first}, {at_degrees(degrees), soft, second}});
          // The place at which the sphere touches both walls.
          const Vec3 rest = kCornerTool_m * (at_degrees(0.0) + at_degrees(degrees)) /
                            (1.0 + std::cos(degrees * std::numbers::pi / 180.0));
          const Vec3 along = rest.normalized();
          const Vec3 across = Vec3::UnitZ().cross(along);
          const std::array<Vec3, 4> path{
              rest - 0.001 * along - 0.0015 * across, rest - 0.001 * along + 0.0015 * across,
              rest - 0.004 * along + 0.0015 * across, rest - 0.004 * along - 0.0015 * across};
          corner.touch(rest + 0.01 * along);
          given_out_J(corner, path);
          EXPECT_NEAR(given_out_J(corner, path), 0.0, 1e-9)
              << name_of(first) << ' ' << hard << " N/m, " << name_of(second) << ' ' << soft
              << " N/m, " << degrees << " degrees";
        }
      }
    }
  }
}

TEST(CornerOfStiffnesses, OfThreeGivesNothingOutOnAClosedPath) {
  for (const Vec3& third : {Vec3(0, 0, 1), Vec3(0.3, 0.1, 1), Vec3(-0.2, 0.3, 1)}) {
    Corner corner({{Vec3::UnitX(), 1000.0},
                   {Vec3::UnitY(), 200.0, Kind::box},
                   {third.normalized(), 500.0, Kind::mesh}});
    const std::array<Vec3, 4> path{Vec3(0.001, -0.001, -0.001), Vec3(-0.001, 0.001, 0.001),
                                   Vec3(-0.001, -0.001, 0.004), Vec3(0.001, 0.001, -0.001)};
    corner.touch(Vec3::Constant(0.01));
    given_out_J(corner, path);
    EXPECT_NEAR(given_out_J(corner, path), 0.0, 1e-9) << third.transpose();
  }
}

// The potential of a corner, in the coordinates of the pressures, for a proxy that friction holds
// back along the corner by a lag.
double potential_J(const ProxyRest& rest, const std::array<double, 3>& stiffness,
                   double lag_m = 0.0) {
  Vec3 stretch = Vec3::Zero();
  double squares = 0.0;
  double weighted = 0.0;
  for (std::size_t i = 0; i < rest.plane_count; ++i) {
    stretch += rest.pressure_m[i] * rest.planes[i].plane.normal;
    squares += rest.pressure_m[i] * rest.pressure_m[i];
    weighted += stiffness[i] * rest.pressure_m[i] * rest.pressure_m[i];
  }
  return 0.5 * weighted / squares * (stretch.squaredNorm() + lag_m * lag_m);
}

// Returns the stretch over the planes, and sets the normal that they have together.
Vec3 stretch_over(ProxyRest& rest) {
  Vec3 stretch = Vec3::Zero();
  for (std::size_t i = 0; i < rest.plane_count; ++i) {
    stretch += rest.pressure_m[i] * rest.planes[i].plane.normal;
  }
  rest.normal_W = stretch.normalized();
  return stretch;
}

// Returns the springs of surfaces that the hand has pressed all along.
std::array<PlaneSpring, 3> linear(const std::array<double, 3>& stiffness_N_per_m) {
  std::array<PlaneSpring, 3> springs{};
  std::ranges::transform(stiffness_N_per_m, springs.begin(), [](double stiffness) {
    return PlaneSpring{.stiffness_N_per_m = stiffness};
  });
  return springs;
}

TEST(CornerSpring, IsTheGradientOfThePotential) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(0.0, 1.0);
  int tried = 0;
  while (tried < 1000) {
    ProxyRest rest{.plane_count = static_cast<std::uint8_t>(2 + tried % 2)};
    std::array<double, 3> stiffness{};
    for (std::size_t i = 0; i < rest.plane_count; ++i) {
      rest.planes[i].plane.normal =
          (Vec3::Constant(0.3) + Vec3(any(random), any(random), any(random)) -
           0.5 * Vec3::Unit(static_cast<Eigen::Index>(i)))
              .normalized();
      rest.pressure_m[i] = 1e-3 + 3e-3 * any(random);
      stiffness[i] = 950.0 + 100.0 * any(random);
    }
    Mat3 normals;
    for (int i = 0; i < 3; ++i) {
      normals.col(i) = rest.planes[static_cast<std::size_t>(i)].plane.normal;
    }
    if (rest.plane_count == 2) {
      normals.col(2) = normals.col(0).cross(normals.col(1)).normalized();
    }
    const Mat3 cosines = normals.transpose() * normals - Mat3::Identity();
    if (std::abs(normals.determinant()) < 0.5 || cosines.maxCoeff() > 0.5) {
      continue;
    }
    ++tried;
    // Between two planes friction may hold the proxy back along their crease.
    const Vec3 over_planes = stretch_over(rest);
    const bool lags = rest.plane_count == 2 && cosines.maxCoeff() < 0.2;
    const double lag_m = lags ? any(random) * over_planes.norm() : 0.0;
    const Vec3 stretch = over_planes + lag_m * normals.col(2);
    const CornerSpring spring = corner_spring(rest, linear(stiffness), stretch);
    const Vec3 force = spring.stiffness_N_per_m * stretch + spring.sideways_W;
    if (lags) {
      ASSERT_NEAR(spring.sideways_W.dot(normals.col(2)), 0.0, 1e-12) << "across the crease";
    }
    // A change of one pressure is a step of the stretch along that normal.
    constexpr double kNudge_m = 1e-7;
    for (std::size_t i = 0; i < rest.plane_count; ++i) {
      ProxyRest more = rest;
      ProxyRest less = rest;
      more.pressure_m[i] += kNudge_m;
      less.pressure_m[i] -= kNudge_m;
      const double slope =
          (potential_J(more, stiffness, lag_m) - potential_J(less, stiffness, lag_m)) /
          (2.0 * kNudge_m);
      ASSERT_NEAR(force.dot(rest.planes[i].plane.normal), slope, 1e-6);
    }
  }
}

// The slope of the force along any direction. Between normals nearer to parallel or opposite the
// first part of the force alone is steep, since it passes from one stiffness to the other.
void expect_about_twice_as_stiff(double lag) {
  constexpr double kHard = 1000.0;
  for (double degrees = 30.0; degrees < 171.0; degrees += 1.0) {
    const Vec3 n0 = at_degrees(0.0);
    const Vec3 n1 = at_degrees(degrees);
    const auto force_at = [&](double first, double second) {
      ProxyRest rest{.pressure_m = {first, second, 0.0}, .plane_count = 2};
      rest.planes[0].plane.normal = n0;
      rest.planes[1].plane.normal = n1;
      const Vec3 stretch = stretch_over(rest) + lag * Vec3::UnitZ();
      const CornerSpring spring = corner_spring(rest, linear({kHard, 200.0, 0.0}), stretch);
      EXPECT_TRUE(spring.sideways_W.allFinite());
      return Vec3{spring.stiffness_N_per_m * stretch + spring.sideways_W};
    };
    for (double first = 0.05; first < 1.0; first += 0.05) {
      constexpr double kNudge = 1e-5;
      const double second = 1.0 - first;
      const Vec3 here = force_at(first, second);
      const Vec3 by_first = (force_at(first + kNudge, second) - here) / kNudge;
      const Vec3 by_second = (force_at(first, second + kNudge) - here) / kNudge;
      // Along the direction u = a n0 + b n1 of unit length.
      for (double angle = 0.0; angle < 180.0; angle += 5.0) {
        const Vec3 u = at_degrees(angle);
        const double b = u.x() / n1.x();
        const double a = u.y() - b * n1.y();
        EXPECT_LE((a * by_first + b * by_second).dot(u), 2.3 * kHard)
            << degrees << " degrees, " << first << ", lag " << lag;
      }
    }
  }
}

TEST(CornerSpring, IsAtMostAboutTwiceAsStiffAsItsHardestSurface) {
  expect_about_twice_as_stiff(0.0);
}

TEST(CornerSpring, IsAsStiffWhereFrictionHoldsTheProxyBack) {
  for (const double lag : {0.3, 0.6, 1.0, 3.0}) {
    expect_about_twice_as_stiff(lag);
  }
}

}  // namespace
}  // namespace tactus::rendering
