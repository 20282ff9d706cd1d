// The walls of a crease: remembered while they stand beside the proxy, forgotten where they end.
#include "rendering/contact/crease_walls.h"

#include <gtest/gtest.h>

#include "rendering/contact/implicit_planes.h"
#include "rendering/contact/implicit_sample.h"
#include "tests/unit/rendering/implicit/implicit_scene.h"

namespace tactus::rendering {
namespace {

constexpr double kWallRest_m = kImplicitRest_m;

// Returns how many planes the walls add beside a proxy at p.
std::size_t planes_at(CreaseWalls& walls, const FormulaSurface& surface, const Vec3& p) {
  ImplicitField field(surface.surface, 1.0, kMaxFormulaBudget);
  ImplicitPlanes planes;
  walls.add_planes(field, sample(field, p), planes);
  return planes.size();
}

TEST(CreaseWalls, AWallGoesAlongWithTheProxyUntilItEnds) {
  // A floor, and a wall at x = 0 that ends at z = 1.
  const FormulaSurface corner("min(y, max(x, z - 1))");
  CreaseWalls walls;
  walls.add({-kWallRest_m, 0.0, 0.0});
  EXPECT_EQ(planes_at(walls, corner, {kWallRest_m, 0.9 * kWallRest_m, 0.0}), 1U);
  EXPECT_EQ(planes_at(walls, corner, {kWallRest_m, 0.9 * kWallRest_m, 0.5}), 1U);
  EXPECT_EQ(planes_at(walls, corner, {kWallRest_m, 0.9 * kWallRest_m, 2.0}), 0U);
  EXPECT_EQ(planes_at(walls, corner, {kWallRest_m, 0.9 * kWallRest_m, 0.5}), 0U);
}

TEST(CreaseWalls, TheGroundIsNoWall) {
  const FormulaSurface ground("y");
  CreaseWalls walls;
  walls.add({1e-6, -kWallRest_m, 0.0});
  EXPECT_EQ(planes_at(walls, ground, {0.0, kWallRest_m, 0.0}), 0U);
}

TEST(CreaseWalls, TheFarSideOfAThinWallIsNone) {
  const FormulaSurface thin("min(y, abs(x))");
  CreaseWalls walls;
  walls.add({-1.5 * kWallRest_m, 0.0, 0.0});
  EXPECT_EQ(planes_at(walls, thin, {kWallRest_m, 0.9 * kWallRest_m, 0.0}), 0U);
}

TEST(CreaseWalls, OfThreeTheOldestIsForgotten) {
  const FormulaSurface corner("min(min(x, y), z)");
  CreaseWalls walls;
  walls.add({-kWallRest_m, 0.0, 0.0});
  walls.add({0.0, -kWallRest_m, 0.0});
  walls.add({0.0, 0.0, -kWallRest_m});
  EXPECT_EQ(planes_at(walls, corner, {kWallRest_m, kWallRest_m, kWallRest_m}), 2U);
  walls.clear();
  EXPECT_EQ(planes_at(walls, corner, {kWallRest_m, kWallRest_m, kWallRest_m}), 0U);
}

}  // namespace
}  // namespace tactus::rendering
