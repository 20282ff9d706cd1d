#include "firmware/safety/pushing_together.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <random>
#include <span>
#include <vector>

#include "firmware/control/controller.h"
#include "rendering/world/world.h"
#include "tests/support/share.h"

namespace tactus::firmware {
namespace {

using rendering::ContactMethod;
using rendering::Effect;
using rendering::Object;
using rendering::PrimitiveKind;

constexpr double kRadius_m = 0.002;
constexpr double kMaxForce_N = 8.0;

// 1,000 N/m with any damping up to 4 N s/m.
StiffnessCertificate level() {
  StiffnessCertificate certificate;
  certificate.count = 2;
  certificate.points[0] = {.damping_Ns_per_m = 0.0, .stiffness_N_per_m = 1000.0};
  certificate.points[1] = {.damping_Ns_per_m = 4.0, .stiffness_N_per_m = 1000.0};
  return certificate;
}

Object solid(PrimitiveKind kind, const Vec3& place_W, const std::array<double, 3>& dimensions_m,
             double stiffness_N_per_m) {
  Object object;
  object.surface = rendering::SurfaceKind::primitive;
  object.primitive.kind = kind;
  object.primitive.X_WO.translation = place_W;
  object.primitive.dimensions_m = dimensions_m;
  object.material.stiffness_N_per_m = stiffness_N_per_m;
  return object;
}

// A cube of 2 cm.
Object cube(const Vec3& place_W, double stiffness_N_per_m) {
  return solid(PrimitiveKind::box, place_W, {0.01, 0.01, 0.01}, stiffness_N_per_m);
}

// The half space below a height of 0 along the normal.
Object plane(const Vec3& normal_W, double stiffness_N_per_m) {
  Object object = solid(PrimitiveKind::plane, Vec3::Zero(), {}, stiffness_N_per_m);
  const Vec3 along_W = normal_W.unitOrthogonal();
  object.primitive.X_WO.rotation << along_W, normal_W, along_W.cross(normal_W);
  return object;
}

Object field(Object object) {
  object.method = ContactMethod::potential_field;
  return object;
}

Effect spring(double stiffness_N_per_m, double damping_Ns_per_m = 0.0) {
  return {.law = rendering::SpringDamper{.spring = {.stiffness_N_per_m = stiffness_N_per_m},
                                         .damping_Ns_per_m = damping_Ns_per_m},
          .max_force_N = 20.0};
}

Effect snap(const Vec3& place_W, double stiffness_N_per_m) {
  return {.law = rendering::SnapToPoint{.point_W = place_W,
                                        .law = {.stiffness_N_per_m = stiffness_N_per_m,
                                                .capture_m = 0.005}},
          .max_force_N = 2.0};
}

// Returns the part that the check refuses when the controller loads the scene; nothing if it
// accepts.
std::optional<UncertifiedPart> refused(std::span<const Object> objects,
                                       std::span<const Effect> effects = {}) {
  ControllerConfig config = cartesian_config();
  config.certificate = level();
  config.safety.max_force_N = kMaxForce_N;
  const auto controller = std::make_unique<Controller>();
  EXPECT_TRUE(controller->configure(config));
  const auto loaded =
      controller->load_scene(objects, {.tool_radius_m = kRadius_m, .effects = effects});
  if (loaded) {
    return std::nullopt;
  }
  EXPECT_EQ(loaded.error().fault, SceneFault::uncertified);
  return loaded.error().part;
}

TEST(PushingTogether, TwoFieldsInOnePlaceCountWithTheirSum) {
  const std::array objects{field(cube(Vec3::Zero(), 600.0)), field(cube(Vec3::Zero(), 500.0))};
  const auto part = refused(objects);
  ASSERT_TRUE(part);
  EXPECT_NEAR(part->stiffness_N_per_m, 1100.0, 1e-3);
  EXPECT_EQ(part->limit_N_per_m, 1000.0);
  EXPECT_EQ(part->index, 0U);
  ASSERT_EQ(part->other_count, 1U);
  ASSERT_EQ(part->listed, 1U);
  EXPECT_EQ(part->others[0].index, 1U);
}

TEST(PushingTogether, FieldsThatNoToolFeelsAtOncePass) {
  // A tool of 2 mm feels both up to a gap of 4 mm.
  const auto at = [](double gap_m) {
    return std::array{field(cube(Vec3::Zero(), 900.0)),
                      field(cube({0.02 + gap_m, 0.0, 0.0}, 900.0))};
  };
  EXPECT_TRUE(refused(at(0.0039)));
  EXPECT_FALSE(refused(at(0.005)));
}

TEST(PushingTogether, ManyFieldsOnOneFloorCountOnlyWhereTheyMeet) {
  std::vector<Object> objects{
      field(solid(PrimitiveKind::box, {0.0, -0.01, 0.0}, {1.0, 0.01, 1.0}, 400.0))};
  for (int i = 0; i < 10; ++i) {
    objects.push_back(field(cube({-0.5 + 0.1 * i, 0.01, 0.0}, 500.0)));
  }
  EXPECT_FALSE(refused(objects));
  objects.push_back(field(cube({0.1, 0.01, 0.005}, 200.0)));
  const auto part = refused(objects);
  ASSERT_TRUE(part);
  EXPECT_NEAR(part->stiffness_N_per_m, 1100.0, 1e-3);
  EXPECT_EQ(part->other_count, 2U);
}

TEST(PushingTogether, TwoWallsInOnePlaceCountWithTheirSum) {
  EXPECT_TRUE(refused(std::array{cube(Vec3::Zero(), 600.0), cube(Vec3::Zero(), 600.0)}));
  EXPECT_TRUE(refused(std::array{plane(Vec3::UnitY(), 600.0), plane(Vec3::UnitY(), 600.0)}));
  // A slab whose top is the floor's.
  EXPECT_TRUE(refused(std::array{plane(Vec3::UnitY(), 600.0), cube({0.0, -0.01, 0.0}, 600.0)}));
  const auto ball = solid(PrimitiveKind::sphere, Vec3::Zero(), {0.02}, 600.0);
  EXPECT_TRUE(refused(std::array{ball, ball}));
}

// The proxy that they share makes the force of one of them, or of their mean.
TEST(PushingTogether, WallsThatMakeAFloorACornerOrAStepPass) {
  const Object one = cube(Vec3::Zero(), 900.0);
  EXPECT_FALSE(refused(std::array{one, cube({0.02, 0.0, 0.0}, 900.0)}));
  EXPECT_FALSE(refused(std::array{one, cube({0.02, 0.02, 0.0}, 900.0)}));
  EXPECT_FALSE(refused(std::array{one, cube({0.01, 0.01, 0.01}, 900.0)}));
  EXPECT_FALSE(refused(std::array{plane(Vec3::UnitX(), 900.0), plane(Vec3::UnitY(), 900.0),
                                  cube({0.0, 0.01, 0.0}, 900.0)}));
}

TEST(PushingTogether, PlanesCountByTheAngleBetweenThem) {
  const auto at = [](double angle) {
    const Vec3 other(std::sin(angle), std::cos(angle), 0.0);
    return std::array{field(plane(Vec3::UnitY(), 600.0)), field(plane(other, 600.0))};
  };
  EXPECT_FALSE(refused(at(std::numbers::pi / 2.0)));
  // 600 n n^T and 600 m m^T have the largest eigenvalue 600 (1 + |n . m|).
  EXPECT_FALSE(refused(at(std::acos(0.66))));
  const auto part = refused(at(std::acos(0.67)));
  ASSERT_TRUE(part);
  EXPECT_NEAR(part->stiffness_N_per_m, 1002.0, 1e-3);
  // The proxy sticks to a rough one, so that it resists along the surface as well.
  auto rough = at(std::numbers::pi / 2.0);
  rough[0].method = ContactMethod::sphere_proxy;
  EXPECT_FALSE(refused(rough));
  rough[0].material.friction = rendering::cone_friction(0.5, 0.4);
  EXPECT_TRUE(refused(rough));
}

TEST(PushingTogether, EffectsCountWithTheWallsWhereTheyAreFelt) {
  const std::array wall{cube(Vec3::Zero(), 900.0)};
  EXPECT_TRUE(refused(wall, std::array{spring(200.0)}));
  EXPECT_FALSE(refused(wall, std::array{spring(100.0)}));
  EXPECT_TRUE(refused(wall, std::array{snap({0.01, 0.0, 0.0}, 200.0)}));
  // The wall is felt from 12 mm on, the snap to 5 mm.
  EXPECT_TRUE(refused(wall, std::array{snap({0.0165, 0.0, 0.0}, 200.0)}));
  EXPECT_FALSE(refused(wall, std::array{snap({0.0175, 0.0, 0.0}, 200.0)}));
  EXPECT_TRUE(refused({}, std::array{spring(600.0), snap(Vec3::Zero(), 600.0)}));
  EXPECT_FALSE(refused({}, std::array{snap({0.02, 0.0, 0.0}, 600.0), snap(Vec3::Zero(), 600.0)}));
}

// A plate of 2 mm is felt to a depth of 8 N / 900 N/m from either side, 9 mm from its middle.
TEST(PushingTogether, AThinPlateIsFeltBehindIt) {
  const std::array plate{solid(PrimitiveKind::box, Vec3::Zero(), {0.001, 0.1, 0.1}, 900.0)};
  EXPECT_TRUE(refused(plate, std::array{snap({0.0145, 0.0, 0.0}, 200.0)}));
  EXPECT_FALSE(refused(plate, std::array{snap({0.0155, 0.0, 0.0}, 200.0)}));
}

TEST(PushingTogether, MagnetsAndBoundedSpringsCountByTheirDistance) {
  const std::array wall{cube(Vec3::Zero(), 900.0)};
  const auto magnet = [](double away_m) {
    return std::array{Effect{.law = rendering::Magnet{.pole_W = {0.012 + away_m, 0.0, 0.0},
                                                      .strength_N = 2.0,
                                                      .core_m = 0.01},
                             .max_force_N = 8.0}};
  };
  // 519.6 N/m in the middle, and 100 N/m across the way at 14.1 mm: (1 + 2)^(-3/2) is 0.1925.
  EXPECT_TRUE(refused(wall, magnet(0.0140)));
  EXPECT_FALSE(refused(wall, magnet(0.0145)));
  const auto bounded = [](double away_m) {
    return std::array{Effect{.law = rendering::Spring{.anchor_W = {0.012 + away_m, 0.0, 0.0},
                                                      .stiffness_N_per_m = 500.0},
                             .max_force_N = 2.0}};
  };
  // 2 N over 20 mm are 100 N/m.
  EXPECT_TRUE(refused(wall, bounded(0.0195)));
  EXPECT_FALSE(refused(wall, bounded(0.0205)));
}

TEST(PushingTogether, DampingsAddUp) {
  const auto part = refused({}, std::array{spring(1.0, 2.5), spring(1.0, 2.5)});
  ASSERT_TRUE(part);
  EXPECT_EQ(part->damping_Ns_per_m, 5.0);
  EXPECT_EQ(part->most_damping_Ns_per_m, 4.0);
  EXPECT_FALSE(refused({}, std::array{spring(1.0, 2.0), spring(1.0, 2.0)}));
}

// With a damping of 4 N s/m 2,000 N/m are certified, but not where the drag is not felt.
TEST(PushingTogether, DampingThatIsNotFeltEverywhereHelpsNoStiffnessElsewhere) {
  StiffnessCertificate certificate = level();
  certificate.points[1].stiffness_N_per_m = 2000.0;
  const std::array effects{
      spring(900.0),
      Effect{.law = rendering::FluidDrag{.volume = cube(Vec3::Zero(), 0.0).primitive,
                                         .linear_Ns_per_m = 4.0},
             .max_force_N = 2.0},
      snap(Vec3::Zero(), 500.0)};
  const auto part = first_uncertified(certificate, {}, effects);
  ASSERT_TRUE(part);
  EXPECT_NEAR(part->stiffness_N_per_m, 1400.0, 1e-3);
  EXPECT_EQ(part->others[0].index, 2U);
  const std::array damped{spring(900.0, 2.0), spring(500.0, 2.0)};
  EXPECT_FALSE(first_uncertified(certificate, {}, damped));
}

TEST(PushingTogether, AnObjectThatMovesMayComeAnywhere) {
  std::array objects{field(cube(Vec3::Zero(), 600.0)), field(cube({1.0, 0.0, 0.0}, 600.0))};
  EXPECT_FALSE(refused(objects));
  objects[1].moves = true;
  EXPECT_TRUE(refused(objects));
}

TEST(PushingTogether, AllEffectsOfASceneCountTogether) {
  std::vector<Effect> effects(rendering::kMaxEffects, spring(62.6, 0.01));
  const auto part = refused({}, effects);
  ASSERT_TRUE(part);
  EXPECT_NEAR(part->stiffness_N_per_m, 1001.6, 1e-3);
  EXPECT_EQ(part->other_count, 15U);
  EXPECT_EQ(part->listed, 3U);
  effects.assign(rendering::kMaxEffects, spring(62.4, 0.01));
  EXPECT_FALSE(refused({}, effects));
}

// Sixteen have 992 N/m; what may come on top of them counts, one by one or not.
TEST(PushingTogether, MorePartsThanASetHoldsCountTogether) {
  std::vector<Object> objects(20, field(cube(Vec3::Zero(), 62.0)));
  const auto part = refused(objects);
  ASSERT_TRUE(part);
  EXPECT_NEAR(part->stiffness_N_per_m, 1240.0, 1e-3);
  EXPECT_EQ(part->other_count, 19U);
  EXPECT_EQ(part->listed, 3U);
  objects.assign(20, field(cube(Vec3::Zero(), 49.0)));
  EXPECT_FALSE(refused(objects));
}

TEST(PushingTogether, ASetIsHeldAgainstWhatIsFeltThereToo) {
  ControllerConfig config = cartesian_config();
  config.certificate = level();
  const auto controller = std::make_unique<Controller>();
  ASSERT_TRUE(controller->configure(config));
  const std::array objects{field(cube(Vec3::Zero(), 400.0)), field(cube(Vec3::Zero(), 400.0)),
                           field(cube({1.0, 0.0, 0.0}, 400.0))};
  ASSERT_TRUE(controller->load_scene(objects, {.tool_radius_m = kRadius_m}));
  const auto set = [&](std::uint32_t object, double stiffness) {
    return controller->set_parameter(
        {.place = {.parameter = Parameter::stiffness, .object = object}, .value = stiffness});
  };
  EXPECT_TRUE(set(2, 1000.0));
  const auto refused = set(1, 700.0);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error(), ParameterRefusal::uncertified);
  EXPECT_NEAR(controller->uncertified_part().stiffness_N_per_m, 1100.0, 1e-3);
  ASSERT_EQ(controller->uncertified_part().other_count, 1U);
  EXPECT_EQ(controller->uncertified_part().others[0].index, 0U);
  // The value that the other object was set to counts, not the scene's.
  EXPECT_TRUE(set(0, 300.0));
  EXPECT_TRUE(set(1, 700.0));
  EXPECT_FALSE(set(0, 301.0));
}

TEST(PushingTogether, ACertificateIsHeldAgainstWhatWasSetSinceTheSceneWasLoaded) {
  const auto controller = std::make_unique<Controller>();
  ASSERT_TRUE(controller->configure(cartesian_config()));
  const std::array objects{field(cube(Vec3::Zero(), 400.0)), field(cube(Vec3::Zero(), 400.0))};
  ASSERT_TRUE(controller->load_scene(objects, {.tool_radius_m = kRadius_m}));
  ASSERT_TRUE(controller->set_parameter(
      {.place = {.parameter = Parameter::stiffness, .object = 1}, .value = 700.0}));
  ControllerConfig config = cartesian_config();
  config.certificate = level();
  EXPECT_FALSE(controller->configure(config));
}

// How stiff a scene is where the tool is: the largest eigenvalue of the force's slope, by
// differences, of a world that the tool has entered on a straight way.
double felt_stiffness(rendering::World& world, const Vec3& from_W, const Vec3& p_W) {
  constexpr double kStep_m = 1e-6;
  world.reset();
  for (int i = 0; i <= 40; ++i) {
    world.touch({.p_W = from_W + i / 40.0 * (p_W - from_W)});
  }
  Mat3 slope = Mat3::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 step = kStep_m * Vec3::Unit(axis);
    const Vec3 before = world.touch({.p_W = p_W - step}).force_W;
    const Vec3 after = world.touch({.p_W = p_W + step}).force_W;
    slope.col(axis) = (before - after) / (2.0 * kStep_m);
    world.touch({.p_W = p_W});
  }
  const Mat3 symmetric = 0.5 * (slope + slope.transpose());
  return Eigen::SelfAdjointEigenSolver<Mat3>(symmetric).eigenvalues()[2];
}

// Whatever random scenes of walls, fields and effects make the hand feel at random places, a
// certificate of a little less refuses the scene.
TEST(PushingTogether, NoPlaceOfASceneIsStifferThanTheCheckSays) {
  std::mt19937 random(22);
  const auto uniform = [&](double least, double most) {
    return std::uniform_real_distribution(least, most)(random);
  };
  const auto place = [&] {
    Vec3 p_W;
    for (double& coordinate : p_W) {
      coordinate = uniform(-0.02, 0.02);
    }
    return p_W;
  };
  const auto world = std::make_unique<rendering::World>();
  int together = 0;
  const int scenes = std::max(30, tactus::testing::part_of(300));
  for (int scene = 0; scene < scenes; ++scene) {
    const double walls_N_per_m = uniform(200.0, 800.0);
    const std::array objects{
        cube(place(), walls_N_per_m), cube(place(), walls_N_per_m),
        plane(Vec3::UnitY(), walls_N_per_m),
        field(solid(PrimitiveKind::sphere, place(), {0.01}, uniform(200.0, 800.0))),
        field(solid(PrimitiveKind::sphere, place(), {0.01}, uniform(200.0, 800.0)))};
    const std::array effects{
        snap(place(), uniform(10.0, 300.0)),
        Effect{.law = rendering::Magnet{.pole_W = place(), .strength_N = uniform(-1.0, 1.0)},
               .max_force_N = 5.0},
        Effect{.law = rendering::Spring{.anchor_W = place(),
                                        .stiffness_N_per_m = uniform(10.0, 300.0)},
               .max_force_N = 1.0}};
    ASSERT_TRUE(world->set_scene(objects, {.tool_radius_m = kRadius_m, .effects = effects}));
    double stiffest = 0.0;
    for (int i = 0; i < 30; ++i) {
      const Vec3 way_W = place().normalized();
      const double felt = felt_stiffness(*world, 0.08 * way_W + Vec3(0.0, 0.08, 0.0), place());
      // A jump of a field or of the proxy is no stiffness.
      stiffest = felt < 5000.0 ? std::max(stiffest, felt) : stiffest;
    }
    StiffnessCertificate certificate;
    certificate.count = 1;
    certificate.points[0].stiffness_N_per_m = 0.98 * stiffest;
    const auto part = first_uncertified(certificate, objects, effects,
                                        {.tool_radius_m = kRadius_m, .max_force_N = kMaxForce_N});
    ASSERT_TRUE(part) << "scene " << scene << ": " << stiffest << " N/m";
    together += part->other_count > 0 ? 1 : 0;
  }
  EXPECT_GT(together, scenes / 6);
}

// The proxy is shared: the wall that lies in the other adds nothing.
TEST(PushingTogether, TwoWallsInOnePlaceAreFeltAsOne) {
  const std::array objects{cube(Vec3::Zero(), 600.0), cube(Vec3::Zero(), 600.0)};
  const auto world = std::make_unique<rendering::World>();
  ASSERT_TRUE(world->set_scene(objects, {.tool_radius_m = kRadius_m}));
  EXPECT_NEAR(felt_stiffness(*world, {0.05, 0.0, 0.0}, {0.011, 0.0, 0.0}), 600.0, 0.6);
}

}  // namespace
}  // namespace tactus::firmware
