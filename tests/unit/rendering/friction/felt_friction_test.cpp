// The friction models felt through the whole renderer. The oracle is the model itself, driven by
// hand; the other tests here show that the model is right.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "rendering/friction/friction_model.h"
#include "rendering/friction/grain.h"
#include "rendering/world/world.h"
#include "tests/support/connected_solid.h"
#include "tests/support/materials.h"
#include "tests/support/solid.h"
#include "tests/unit/rendering/friction/every_kind.h"

namespace tactus::rendering {
namespace {

using testing::ConnectedSolid;
using testing::every_kind;
using testing::kMicron;
using testing::NamedFriction;
using testing::Solid;

constexpr double kFeltStiffness_N_per_m = 1000.0;
constexpr double kFeltTick_s = 1e-3;
constexpr double kFeltBristle_N_per_m = 400.0;

Vec3 along_plate(const Vec3& v) {
  return {v.x(), 0.0, v.z()};
}

// The half space y <= 0, in every way that a friction model can hold a proxy over it.
struct Plate {
  std::string name;
  Object object;
  double radius_m = 0.0;
};

class FeltFriction : public ::testing::TestWithParam<NamedFriction> {
 protected:
  std::vector<Plate> plates(const FrictionParameters& friction) {
    const Material material{.stiffness_N_per_m = kFeltStiffness_N_per_m, .friction = friction};
    Object sheet = solid_.object();
    sheet.material = material;
    Object point = sheet;
    point.method = ContactMethod::god_object;
    Object walked = point;
    walked.method = ContactMethod::feature_walk;
    walked.mesh = connected_.mesh().mesh;
    walked.neighbours = connected_.mesh().neighbours;
    walked.vertex_normals = connected_.mesh().vertex_normals;
    Object plane{.surface = SurfaceKind::primitive,
                 .primitive = {.kind = PrimitiveKind::plane},
                 .material = material};
    return {{"sheet, sphere of 2 mm", sheet, 0.002},
            {"sheet, point", point, 0.0},
            {"box, feature walk", walked, 0.0},
            {"plane, sphere of 2 mm", plane, 0.002}};
  }

  void take(const Plate& plate) {
    object_ = plate.object;
    ASSERT_TRUE(world_->set_scene({&object_, 1}, {.tool_radius_m = plate.radius_m}));
    world_->touch({.p_W = {0.0, plate.radius_m + 0.001, 0.0}});
  }

  Solid solid_{testing::flat_sheet(0.01, 40), Sides::one, {}};
  ConnectedSolid connected_{[] {
    testing::Shape box = testing::box({0.4, 0.4, 0.4});
    for (Float3& v : box.vertices) {
      v.y -= 0.2F;
    }
    return box;
  }()};
  Object object_;
  std::unique_ptr<World> world_ = std::make_unique<World>();
};

// The cone has its own rule: cone_test.cpp.
std::vector<NamedFriction> all_but_the_cone() {
  std::vector<NamedFriction> kinds = every_kind(kFeltBristle_N_per_m);
  std::erase_if(
      kinds, [](const NamedFriction& kind) { return kind.parameters.kind == FrictionKind::cone; });
  return kinds;
}

// Strokes that start, stop, turn and press more and less.
class UnevenStroke {
 public:
  UnevenStroke(std::uint64_t seed, double radius_m) : random_(seed), radius_m_(radius_m) {}

  Vec3 next() {
    velocity_ += 0.02 * Vec3(bell_(random_), 0.0, bell_(random_));
    velocity_ *= ++tick_ / 100 % 3 == 2 ? 0.0 : 0.95;
    place_ += kFeltTick_s * velocity_;
    const double depth = 0.002 + 0.0015 * std::sin(0.013 * tick_);
    return {place_.x(), radius_m_ - depth, place_.z()};
  }

 private:
  std::mt19937_64 random_;
  std::normal_distribution<double> bell_;
  double radius_m_;
  Vec3 velocity_ = Vec3::Zero();
  Vec3 place_ = Vec3::Zero();
  int tick_ = 0;
};

class FeltModel : public FeltFriction {};

TEST_P(FeltModel, TheProxyLagsByTheModelsForceOverTheStiffness) {
  constexpr std::uint64_t kStrokeSeed = 401;
  const FrictionParameters friction = GetParam().parameters;
  for (const Plate& plate : plates(friction)) {
    SCOPED_TRACE(plate.name + ", seed 401");
    take(plate);
    UnevenStroke stroke(kStrokeSeed, plate.radius_m);
    FrictionMemory<Vec3> memory;
    Vec3 last = Vec3::Zero();
    for (int tick = 0; tick < 2000; ++tick) {
      const Vec3 tool = stroke.next();
      const Touch touch = world_->touch({.p_W = tool});
      const Vec3 step = tick == 0 ? Vec3::Zero() : along_plate(tool - last);
      const FrictionForce<Vec3> expected = update_friction(
          friction, memory, step, kFeltStiffness_N_per_m * touch.depth_m, kFeltTick_s);
      last = tool;
      const Vec3 lag = along_plate(tool - touch.proxy_W);
      ASSERT_LE((lag - expected.force_N / kFeltStiffness_N_per_m).norm(), 1e-8)
          << "tick " << tick << ", lag " << lag.transpose();
      ASSERT_EQ(touch.friction, expected.slipping ? FrictionState::slip : FrictionState::stick)
          << "tick " << tick;
      ASSERT_EQ(touch.flags, kTouchClean);
    }
  }
}

TEST_P(FeltFriction, ContactMadeAndBrokenDoesNotKick) {
  for (const Plate& plate : plates(GetParam().parameters)) {
    SCOPED_TRACE(plate.name);
    take(plate);
    const auto touch = [&](double x, double depth_m) {
      return world_->touch({.p_W = {x, plate.radius_m - depth_m, 0.0}});
    };
    double x = 0.0;
    for (int round = 0; round < 3; ++round) {
      const Touch first = touch(x, 0.001);
      ASSERT_LE(along_plate(first.force_W).norm(), 1e-5) << "made, round " << round;
      for (int tick = 0; tick < 100; ++tick) {
        touch(x += 1e-4, 0.001);
      }
      for (double depth_m = 0.001; depth_m > 1e-5; depth_m *= 0.7) {
        const Touch unloaded = touch(x, depth_m);
        const double normal_N = kFeltStiffness_N_per_m * unloaded.depth_m;
        ASSERT_LE(along_plate(unloaded.force_W).norm(), 0.8 * normal_N * (1.0 + 1e-6) + 1e-5);
      }
      ASSERT_EQ(touch(x, -0.001).force_W, Vec3::Zero());
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, FeltModel, ::testing::ValuesIn(all_but_the_cone()),
                         [](const auto& kind) { return kind.param.name; });

INSTANTIATE_TEST_SUITE_P(Kinds, FeltFriction, ::testing::ValuesIn(every_kind(kFeltBristle_N_per_m)),
                         [](const auto& kind) { return kind.param.name; });

class FeltFrictionLimits : public FeltFriction {};

// Coulomb without viscosity sticks by the K of the proxy: the cone of equal coefficients.
TEST_F(FeltFrictionLimits, CoulombFrictionIsTheConeOfEqualCoefficients) {
  const FrictionParameters coulomb{.kind = FrictionKind::coulomb_viscous, .coulomb = 0.5};
  const std::vector<Plate> modelled = plates(coulomb);
  const std::vector<Plate> coned = plates(cone_friction(0.5, 0.5));
  const auto cone_world = std::make_unique<World>();
  for (std::size_t k = 0; k < modelled.size(); ++k) {
    SCOPED_TRACE(modelled[k].name + ", seed 402");
    take(modelled[k]);
    ASSERT_TRUE(cone_world->set_scene({&coned[k].object, 1}, {.tool_radius_m = coned[k].radius_m}));
    UnevenStroke stroke(402, modelled[k].radius_m);
    // The cone holds the point where it came in, a model starts without force: so both start in
    // the same place.
    const Vec3 start(0.0, modelled[k].radius_m + 0.001, 0.0);
    cone_world->touch({.p_W = start});
    for (int tick = 0; tick < 2000; ++tick) {
      const Vec3 tool = stroke.next();
      if (tick == 0) {
        const Vec3 above(tool.x(), start.y(), tool.z());
        world_->touch({.p_W = above});
        cone_world->touch({.p_W = above});
      }
      const Touch model = world_->touch({.p_W = tool});
      const Touch cone = cone_world->touch({.p_W = tool});
      ASSERT_LE((model.proxy_W - cone.proxy_W).norm(), 2e-7) << "tick " << tick;
    }
  }
}

// A surface that does not push cannot rub either.
TEST_F(FeltFrictionLimits, WithoutStiffnessThereIsNoFriction) {
  for (const NamedFriction& kind : every_kind(kFeltBristle_N_per_m)) {
    for (Plate& plate : plates(kind.parameters)) {
      SCOPED_TRACE(kind.name + ", " + plate.name);
      plate.object.material.stiffness_N_per_m = 0.0;
      take(plate);
      for (int tick = 0; tick < 20; ++tick) {
        const Touch touch = world_->touch({.p_W = {1e-4 * tick, plate.radius_m - 0.001, 0.0}});
        ASSERT_EQ(touch.force_W, Vec3::Zero()) << "tick " << tick;
        ASSERT_TRUE(touch.proxy_W.allFinite()) << "tick " << tick;
      }
    }
  }
}

// Along the grain nothing, across it all: the force is across whatever way the tool goes.
TEST_F(FeltFrictionLimits, AGrainTurnsTheForceAcross) {
  for (Plate& plate :
       plates({.kind = FrictionKind::dahl, .coulomb = 0.5, .stiffness_N_per_m = 800.0})) {
    SCOPED_TRACE(plate.name);
    plate.object.material.grain = {.direction_O = {1.0F, 1.0F, 0.0F}, .along = 0.0, .across = 1.0};
    take(plate);
    Vec3 tool(0.0, plate.radius_m - 0.002, 0.0);
    Touch touch;
    for (int tick = 0; tick < 500; ++tick) {
      touch = world_->touch({.p_W = tool});
      tool += Vec3(1e-4, 0.0, 0.5e-4);
    }
    EXPECT_NEAR(touch.force_W.x(), 0.0, 1e-5);
    EXPECT_NEAR(touch.force_W.z(), -0.5 * touch.force_W.y(), 1e-4);
  }
}

// Round and round a cylinder, its faces and its edges: what friction took is never given back.
TEST_F(FeltFrictionLimits, RoundCornersNoModelGivesEnergyOrJumps) {
  const Solid cylinder(testing::prism(24, 0.02, 0.04), Sides::one, {});
  for (const NamedFriction& kind : all_but_the_cone()) {
    SCOPED_TRACE(kind.name);
    FrictionParameters friction = kind.parameters;
    // Jumps that no corner makes: where slip begins, these end, or fall to the other.
    friction.damping_s_per_m = 0.0;
    friction.static_level = friction.coulomb;
    friction.viscous_s_per_m = 0.1;
    object_ = cylinder.object();
    object_.material = {.stiffness_N_per_m = kFeltStiffness_N_per_m, .friction = friction};
    ASSERT_TRUE(world_->set_scene({&object_, 1}, {.tool_radius_m = 0.002}));
    double taken_J = 0.0;
    double before_N = 0.0;
    Vec3 last(0.025, 0.0, 0.0);
    world_->touch({.p_W = last});
    for (int tick = 0; tick <= 4000; ++tick) {
      const double angle = 0.5 * M_PI * std::sin(2.0 * M_PI * tick / 1000.0);
      const Vec3 tool = 0.0205 * Vec3(std::cos(angle), std::sin(angle), 0.0);
      const Touch touch = world_->touch({.p_W = tool});
      const Vec3 drag = touch.force_W - touch.force_W.dot(touch.normal_W) * touch.normal_W;
      const Vec3 step = tool - last;
      taken_J -= drag.dot(step - step.dot(touch.normal_W) * touch.normal_W);
      last = tool;
      ASSERT_GE(taken_J, -1e-4) << "tick " << tick;
      const double drag_N = drag.norm();
      if (tick > 1) {
        ASSERT_LE(std::abs(drag_N - before_N), 0.25) << "tick " << tick;
      }
      before_N = drag_N;
    }
    EXPECT_GT(taken_J, 0.01);
  }
}

// A tool that moves with the belt feels no friction; under a still tool the belt drags it by the
// steady level.
TEST_F(FeltFrictionLimits, ABeltDragsAndWhatMovesWithItIsNotDragged) {
  FrictionParameters lugre = every_kind(kFeltBristle_N_per_m)[5].parameters;
  const Solid belt(testing::box({2.0, 0.01, 0.1}), Sides::one,
                   {.stiffness_N_per_m = kFeltStiffness_N_per_m, .friction = lugre});
  object_ = belt.object();
  object_.moves = true;
  constexpr double kSpeed_m_per_s = 0.3;
  for (const bool rides : {false, true}) {
    ASSERT_TRUE(world_->set_scene({&object_, 1}, {.tool_radius_m = 0.002}));
    world_->touch({.p_W = {0.0, 0.02, 0.0}});
    Touch touch;
    for (int tick = 0; tick < 500; ++tick) {
      const double x = kSpeed_m_per_s * kFeltTick_s * tick;
      world_->set_pose(0, {.translation = {x, 0.0, 0.0}}, {.linear_W = {kSpeed_m_per_s, 0.0, 0.0}});
      touch = world_->touch({.p_W = {rides ? x : 0.0, 0.005, 0.0}});
    }
    const double level =
        steady_level(lugre, kSpeed_m_per_s) + lugre.viscous_s_per_m * kSpeed_m_per_s;
    EXPECT_NEAR(touch.force_W.x(), rides ? 0.0 : level * touch.force_W.y(), 2e-3);
    EXPECT_NEAR(touch.proxy_W.y(), 0.007, kMicron);
  }
}

}  // namespace
}  // namespace tactus::rendering
