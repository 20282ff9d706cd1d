// The workspace's walls count against the certificate together with what the scene pushes there.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <random>
#include <span>

#include "firmware/control/controller.h"
#include "firmware/safety/certificate.h"
#include "firmware/safety/faults.h"
#include "firmware/safety/workspace_walls.h"
#include "rendering/world/world.h"
#include "tests/support/share.h"

namespace tactus::firmware {
namespace {

using rendering::Effect;
using rendering::Object;
using rendering::PrimitiveKind;
using Kind = UncertifiedPart::Kind;

constexpr double kWalledTool_m = 0.002;

// A workspace of 10 cm about the origin with walls of 500 N/m, and a certificate of 1,000 N/m up to
// 4 N s/m.
ControllerConfig walled_config() {
  ControllerConfig config = cartesian_config();
  config.safety.max_force_N = 8.0;
  config.safety.workspace_lower_W = Vec3::Constant(-0.05);
  config.safety.workspace_upper_W = Vec3::Constant(0.05);
  config.certificate.count = 2;
  config.certificate.points[0] = {.damping_Ns_per_m = 0.0, .stiffness_N_per_m = 1000.0};
  config.certificate.points[1] = {.damping_Ns_per_m = 4.0, .stiffness_N_per_m = 1000.0};
  return config;
}

Object solid_at(PrimitiveKind kind, const Vec3& place_W, const std::array<double, 3>& dimensions_m,
                double stiffness_N_per_m) {
  Object object;
  object.surface = rendering::SurfaceKind::primitive;
  object.primitive.kind = kind;
  object.primitive.X_WO.translation = place_W;
  object.primitive.dimensions_m = dimensions_m;
  object.material.stiffness_N_per_m = stiffness_N_per_m;
  return object;
}

Object cube_at(const Vec3& place_W, double stiffness_N_per_m) {
  return solid_at(PrimitiveKind::box, place_W, {0.01, 0.01, 0.01}, stiffness_N_per_m);
}

std::optional<UncertifiedPart> refused_within(const ControllerConfig& config,
                                              std::span<const Object> objects,
                                              std::span<const Effect> effects = {}) {
  const auto controller = std::make_unique<Controller>();
  EXPECT_TRUE(controller->configure(config));
  const auto loaded =
      controller->load_scene(objects, {.tool_radius_m = kWalledTool_m, .effects = effects});
  if (loaded) {
    return std::nullopt;
  }
  EXPECT_EQ(loaded.error().fault, SceneFault::uncertified);
  return loaded.error().part;
}

TEST(WallsTogether, AnObjectAtAWallCountsWithIt) {
  const auto part = refused_within(walled_config(), std::array{cube_at({0.05, 0.0, 0.0}, 600.0)});
  ASSERT_TRUE(part);
  EXPECT_EQ(part->kind, Kind::object);
  EXPECT_NEAR(part->stiffness_N_per_m, 1100.0, 1e-3);
  EXPECT_EQ(part->damping_Ns_per_m, 1.0);
  ASSERT_EQ(part->other_count, 1U);
  EXPECT_EQ(part->others[0].kind, Kind::wall);
  EXPECT_EQ(part->others[0].index, 1U) << "the upper wall across x";
  EXPECT_FALSE(refused_within(walled_config(), std::array{cube_at({0.05, 0.0, 0.0}, 499.0)}));
  EXPECT_FALSE(refused_within(walled_config(), std::array{cube_at(Vec3::Zero(), 600.0)}));
}

TEST(WallsTogether, AWallReachesAsFarAsTheToolCanBeInIt) {
  // A tool of 2 mm touches the cube to 12 mm from its middle; 20 mm deep in the wall is a fault.
  EXPECT_TRUE(refused_within(walled_config(), std::array{cube_at({0.0, -0.0815, 0.0}, 600.0)}));
  EXPECT_FALSE(refused_within(walled_config(), std::array{cube_at({0.0, -0.0985, 0.0}, 600.0)}));
  ControllerConfig config = walled_config();
  config.safety.guards_off = kFaultWorkspace;
  EXPECT_TRUE(refused_within(config, std::array{cube_at({0.0, -0.0985, 0.0}, 600.0)}));
}

TEST(WallsTogether, AFloorCountsWithTheWallsOnlyWhereItPushesTheirWay) {
  const auto floor_at = [](double y, double stiffness) {
    return std::array{solid_at(PrimitiveKind::plane, {0.0, y, 0.0}, {}, stiffness)};
  };
  // 600 N/m up and 500 N/m sideways at the sides; the tool is at most 8 N / 600 N/m below it.
  EXPECT_FALSE(refused_within(walled_config(), floor_at(-0.03, 600.0)));
  EXPECT_TRUE(refused_within(walled_config(), floor_at(-0.045, 600.0)));
  auto rough = floor_at(-0.03, 600.0);
  rough[0].material.friction = rendering::cone_friction(0.5, 0.4);
  EXPECT_TRUE(refused_within(walled_config(), rough));
}

TEST(WallsTogether, AFieldCountsByTheFacesThatPushAtTheWall) {
  const auto plate = [](const Vec3& half_m) {
    return std::array{[&] {
      Object object =
          solid_at(PrimitiveKind::box, Vec3::Zero(), {half_m.x(), half_m.y(), half_m.z()}, 600.0);
      object.method = rendering::ContactMethod::potential_field;
      return object;
    }()};
  };
  // The plate goes through the walls across x, and pushes along y there.
  EXPECT_FALSE(refused_within(walled_config(), plate({0.09, 0.004, 0.01})));
  EXPECT_TRUE(refused_within(walled_config(), plate({0.06, 0.004, 0.01})))
      << "its end is at the wall";
}

TEST(WallsTogether, EffectsCountWithTheWalls) {
  const Effect spring{.law = rendering::Spring{.stiffness_N_per_m = 501.0}, .max_force_N = 40.0};
  const auto part = refused_within(walled_config(), {}, std::array{spring});
  ASSERT_TRUE(part);
  EXPECT_EQ(part->kind, Kind::effect);
  EXPECT_EQ(part->others[0].kind, Kind::wall);
}

TEST(WallsTogether, TheDampingOfAWallCountsOnce) {
  ControllerConfig config = walled_config();
  config.safety.workspace_damping_Ns_per_m = 2.0;
  Object object = cube_at(Vec3::Constant(0.05), 100.0);
  object.material.damping_Ns_per_m = 1.9;
  EXPECT_FALSE(refused_within(config, std::array{object}));
  object.material.damping_Ns_per_m = 2.1;
  EXPECT_TRUE(refused_within(config, std::array{object}));
}

TEST(WallsTogether, TheWallIsNamedAmongManyParts) {
  const std::array<Object, 6> objects = [] {
    std::array<Object, 6> all;
    all.fill(cube_at({0.05, 0.0, 0.0}, 90.0));
    for (Object& object : all) {
      object.method = rendering::ContactMethod::potential_field;
    }
    return all;
  }();
  const auto part = refused_within(walled_config(), objects);
  ASSERT_TRUE(part);
  EXPECT_EQ(part->other_count, 6U);
  EXPECT_EQ(part->others[2].kind, Kind::wall);
}

TEST(WallsTogether, ASetIsHeldAgainstTheWallToo) {
  const auto controller = std::make_unique<Controller>();
  ASSERT_TRUE(controller->configure(walled_config()));
  const std::array objects{cube_at({0.05, 0.0, 0.0}, 400.0), cube_at(Vec3::Zero(), 400.0)};
  ASSERT_TRUE(controller->load_scene(objects, {.tool_radius_m = kWalledTool_m}));
  const auto set = [&](std::uint32_t object, double stiffness) {
    return controller->set_parameter(
        {.place = {.parameter = Parameter::stiffness, .object = object}, .value = stiffness});
  };
  EXPECT_TRUE(set(1, 900.0));
  EXPECT_FALSE(set(0, 501.0));
  EXPECT_EQ(controller->uncertified_part().others[0].kind, Kind::wall);
}

TEST(WallsTogether, AWallBeyondTheCertificateByItselfIsRefusedWithItsName) {
  const auto controller = std::make_unique<Controller>();
  ControllerConfig config = walled_config();
  config.safety.workspace_stiffness_N_per_m = 1001.0;
  const auto stiff = controller->configure(config);
  ASSERT_FALSE(stiff);
  EXPECT_EQ(stiff.error().field, "safety.workspace_stiffness_N_per_m");
  EXPECT_EQ(stiff.error().greatest, 1000.0);
  config = walled_config();
  config.safety.workspace_damping_Ns_per_m = 4.5;
  const auto damped = controller->configure(config);
  ASSERT_FALSE(damped);
  EXPECT_EQ(damped.error().field, "safety.workspace_damping_Ns_per_m");
  config.allow_uncertified = true;
  EXPECT_TRUE(controller->configure(config));
}

// The walls of the default are there for no device.
TEST(WallsTogether, WallsThatWereNotSetCountForNothing) {
  ControllerConfig config = walled_config();
  config.safety.workspace_lower_W = SafetyConfig{}.workspace_lower_W;
  config.safety.workspace_upper_W = SafetyConfig{}.workspace_upper_W;
  config.safety.workspace_stiffness_N_per_m = 5000.0;
  Object object = cube_at({9.99, 0.0, 0.0}, 900.0);
  EXPECT_FALSE(refused_within(config, std::array{object}));
}

// The largest eigenvalue of the slope of the force of walls and world by differences, N/m, after a
// straight way into the place. Nothing where the force jumps, or bends as at the end of a contact.
std::optional<double> felt_with_walls(rendering::World& world, const WorkspaceWalls& walls,
                                      const Vec3& p_W) {
  constexpr double kStep_m = 1e-6;
  constexpr double kAlike_N_per_m = 2.0;
  world.reset();
  for (int i = 0; i <= 40; ++i) {
    world.touch({.p_W = i / 40.0 * p_W});
  }
  const auto force = [&](const Vec3& at_W) {
    return Vec3(world.touch({.p_W = at_W}).force_W + walls.push_W({.p_W = at_W}));
  };
  Mat3 slope;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 step = kStep_m * Vec3::Unit(axis);
    const Vec3 here = force(p_W);
    const Vec3 before = force(p_W - step);
    const Vec3 after = force(p_W + step);
    if ((before - 2.0 * here + after).norm() > kAlike_N_per_m * kStep_m) {
      return std::nullopt;
    }
    slope.col(axis) = (before - after) / (2.0 * kStep_m);
  }
  const Mat3 symmetric = 0.5 * (slope + slope.transpose());
  return Eigen::SelfAdjointEigenSolver<Mat3>(symmetric).eigenvalues()[2];
}

TEST(WallsTogether, NoPlaceInAWallIsStifferThanTheCheckSays) {
  constexpr unsigned kSeed = 5501;
  std::mt19937 random(kSeed);
  const auto uniform = [&](double least, double most) {
    return std::uniform_real_distribution(least, most)(random);
  };
  const auto place = [&](double most) {
    const double x = uniform(-most, most);
    const double y = uniform(-most, most);
    return Vec3(x, y, uniform(-most, most));
  };
  const ControllerConfig config = walled_config();
  const auto world = std::make_unique<rendering::World>();
  WorkspaceWalls walls;
  walls.configure(config);
  std::size_t at_walls = 0;
  std::size_t places = 0;  // in a wall and in an object, where the force is smooth
  const unsigned scenes = std::max(20U, tactus::testing::part_of(200U));
  for (unsigned scene = 0; scene < scenes; ++scene) {
    std::array objects{cube_at(place(0.06), uniform(100.0, 900.0)),
                       solid_at(PrimitiveKind::sphere, place(0.06), {0.01}, uniform(100.0, 900.0))};
    objects[0].method = rendering::ContactMethod::potential_field;
    objects[1].method = scene % 2 == 0 ? rendering::ContactMethod::potential_field
                                       : rendering::ContactMethod::sphere_proxy;
    ASSERT_TRUE(world->set_scene(objects, {.tool_radius_m = kWalledTool_m}));
    double stiffest = 0.0;
    for (int i = 0; i < 60; ++i) {
      const auto& middle_W = objects[static_cast<std::size_t>(i % 2)].primitive.X_WO.translation;
      const Vec3 p_W = middle_W + place(0.012);
      if ((walls.check(p_W) & kFaultWorkspace) != 0) {
        continue;
      }
      if (const auto felt = felt_with_walls(*world, walls, p_W)) {
        stiffest = std::max(stiffest, *felt);
        places += *felt > 0.0 && walls.check(p_W) != kNoFault ? 1U : 0U;
      }
    }
    StiffnessCertificate certificate;
    certificate.count = 2;
    certificate.points[0].stiffness_N_per_m = 0.98 * stiffest;
    certificate.points[1] = {.damping_Ns_per_m = 4.0, .stiffness_N_per_m = 0.98 * stiffest};
    const auto part = first_uncertified(certificate, objects, {},
                                        {.tool_radius_m = kWalledTool_m,
                                         .max_force_N = config.safety.max_force_N,
                                         .walls = felt_walls(config.safety)});
    ASSERT_TRUE(part) << "seed " << kSeed << ", scene " << scene << ": " << stiffest << " N/m";
    at_walls += part->other_count > 0 ? 1U : 0U;
  }
  EXPECT_GT(at_walls, scenes / 4);
  EXPECT_GT(places, 5 * scenes);
}

}  // namespace
}  // namespace tactus::firmware
