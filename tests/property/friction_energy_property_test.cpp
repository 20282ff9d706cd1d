// The audit of energy: random closed motions under every model, with a normal force that comes and
// goes, and never does a model give out energy.
//
// The bound: what a model has been given less what its bristle still stores is never below -1e-9 J.
// A changing normal force stores nothing (friction_model.h), so nothing is added for it.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "rendering/friction/bristle_transport.h"
#include "rendering/friction/grain.h"
#include "rendering/friction/lugre_passivity.h"
#include "rendering/geometry/tangential.h"
#include "tests/support/share.h"

namespace tactus::testing {
namespace {

using rendering::FrictionKind;
using rendering::FrictionMemory;
using rendering::FrictionParameters;
using rendering::Grain;
using rendering::tangential;
using rendering::update_friction;

constexpr double kRounding_J = 1e-9;
constexpr std::size_t kMotions = 100'000;

class Dice {
 public:
  explicit Dice(std::uint64_t seed) : random_(seed) {}

  double between(double lower, double upper) {
    return std::uniform_real_distribution<double>(lower, upper)(random_);
  }
  double decades(double lower, double upper) { return std::pow(10.0, between(lower, upper)); }
  bool one_in(int n) { return random_() % static_cast<std::uint64_t>(n) == 0; }
  Vec3 direction() { return Vec3{gauss_(random_), gauss_(random_), gauss_(random_)}.normalized(); }

 private:
  std::mt19937_64 random_;
  std::normal_distribution<double> gauss_;
};

// One that is passive by lugre_passivity, by the one way or the other.
FrictionParameters random_friction(FrictionKind kind, Dice& dice) {
  FrictionParameters p{.kind = kind};
  p.coulomb = dice.between(0.01, 1.5);
  p.static_level = p.coulomb * (dice.one_in(4) ? 1.0 : dice.between(1.0, 3.0));
  p.viscous_s_per_m = dice.one_in(3) ? 0.0 : dice.decades(-3.0, 1.0);
  p.stribeck_velocity_m_per_s = dice.decades(-4.0, 0.0);
  p.stribeck_exponent = dice.one_in(2) ? 2.0 : dice.between(0.5, 3.0);
  p.stiffness_N_per_m = dice.decades(1.0, 5.0);
  p.damping_s_per_m = dice.one_in(4) ? 0.0 : dice.decades(-1.0, 3.0);
  p.stick_velocity_m_per_s = dice.decades(-4.0, 0.0);
  p.elastic_fraction = dice.between(0.1, 0.9);
  const rendering::LugrePassivity advice = lugre_passivity(p);
  if (!advice.passive) {
    if (dice.one_in(2)) {
      p.viscous_s_per_m = advice.needed_viscous_s_per_m;
    } else {
      p.damping_fade_m_per_s = advice.largest_fade_m_per_s;
    }
  }
  if (!rendering::has_bristles(kind) && dice.one_in(4)) {
    p.stiffness_N_per_m = 0.0;
  }
  return p;
}

// The load of a finger: held for a while, drifting, jumping, and now and then gone.
class Load {
 public:
  explicit Load(Dice& dice) : dice_(dice), force_N_(dice.between(0.0, 10.0)) {}

  double next() {
    if (dice_.one_in(10)) {
      force_N_ = dice_.one_in(4) ? 0.0 : dice_.between(0.0, 10.0);
    } else if (dice_.one_in(2)) {
      force_N_ *= dice_.between(0.8, 1.2);
    }
    return force_N_;
  }

 private:
  Dice& dice_;
  double force_N_;
};

struct Worst {
  double given_out_J = 0.0;
  double friction_J = 0.0;  // taken in by all motions, so that the test does not audit nothing
};

// Steps of 1e-9 to 10 m/s, some none at all, some turning straight back; the last one goes home.
template <typename Vector, typename Direction>
std::vector<Vector> closed_motion(double step_s, Dice& dice, const Direction& direction) {
  const auto ticks = static_cast<std::size_t>(dice.between(2.0, 60.0));
  const double fastest = dice.between(-6.0, 1.0);
  std::vector<Vector> steps;
  Vector sum = rendering::zero_tangent<Vector>();
  Vector heading = direction();
  while (steps.size() < ticks) {
    if (dice.one_in(5)) {
      heading = dice.one_in(2) ? Vector{-1.0 * heading} : Vector{direction()};
    }
    const double speed =
        dice.one_in(10) ? 0.0 : dice.decades(std::max(-9.0, fastest - 3.0), fastest);
    steps.push_back(Vector{step_s * speed * heading});
    sum += steps.back();
  }
  steps.push_back(Vector{-1.0 * sum});
  return steps;
}

template <typename Vector, typename Update>
void audit(const FrictionParameters& friction, const std::vector<Vector>& steps, double step_s,
           Dice& dice, const Update& update, Worst& worst) {
  FrictionMemory<Vector> memory;
  Load load(dice);
  double work_J = 0.0;
  for (const Vector& way : steps) {
    work_J += rendering::dot(update(memory, way, load.next(), step_s), way);
    worst.given_out_J = std::max(worst.given_out_J, stored_J(friction, memory) - work_J);
  }
  worst.given_out_J = std::max(worst.given_out_J, -work_J);
  worst.friction_J += work_J;
}

class FrictionEnergy : public ::testing::TestWithParam<FrictionKind> {
 protected:
  [[nodiscard]] std::uint64_t seed() const {
    return 20261121 + static_cast<std::uint64_t>(GetParam());
  }

  static void expect_passive(const Worst& worst) {
    EXPECT_LE(worst.given_out_J, kRounding_J);
    EXPECT_GT(worst.friction_J, 0.0);
  }
};

TEST_P(FrictionEnergy, OfAJointIsNeverGivenOutOverAClosedMotion) {
  SCOPED_TRACE(seed());
  Dice dice(seed());
  Worst worst;
  for (std::size_t i = 0; i < share_of(kMotions); ++i) {
    const FrictionParameters friction = random_friction(GetParam(), dice);
    ASSERT_TRUE(valid(friction));
    const double step_s = dice.one_in(2) ? 1e-3 : dice.decades(-5.0, -1.0);
    const auto steps = closed_motion<double>(step_s, dice, [] { return 1.0; });
    audit(
        friction, steps, step_s, dice,
        [&](auto& memory, double way, double normal, double dt) {
          return update_friction(friction, memory, way, normal, dt).mean_force_N;
        },
        worst);
  }
  expect_passive(worst);
}

TEST_P(FrictionEnergy, OfASurfaceWithAGrainIsNeverGivenOutOverAClosedMotion) {
  SCOPED_TRACE(seed());
  Dice dice(seed());
  Worst worst;
  for (std::size_t i = 0; i < share_of(kMotions); ++i) {
    const FrictionParameters friction = random_friction(GetParam(), dice);
    const double step_s = dice.one_in(2) ? 1e-3 : dice.decades(-5.0, -1.0);
    const auto in_plane = [&] {
      const double angle = dice.between(-M_PI, M_PI);
      return Vec3{std::cos(angle), std::sin(angle), 0.0};
    };
    Grain grain;
    if (dice.one_in(2)) {
      grain = {.direction = in_plane(),
               .along = dice.between(0.0, 1.0),
               .across = dice.between(0.0, 1.0)};
    }
    const auto steps = closed_motion<Vec3>(step_s, dice, in_plane);
    audit(
        friction, steps, step_s, dice,
        [&](auto& memory, const Vec3& way, double normal, double dt) {
          // A grain that wanders, as over a texture.
          if (dice.one_in(5)) {
            grain.direction = in_plane();
            grain.across *= dice.between(0.5, 1.0);
          }
          return update_friction(friction, grain, memory, way, normal, dt).mean_force_N;
        },
        worst);
  }
  expect_passive(worst);
}

// The plane turns with every tick, by a little or by any angle, and the motion lies in it.
TEST_P(FrictionEnergy, OfABentSurfaceIsNeverGivenOut) {
  SCOPED_TRACE(seed());
  Dice dice(seed());
  Worst worst;
  for (std::size_t i = 0; i < share_of(kMotions / 4); ++i) {
    const FrictionParameters friction = random_friction(GetParam(), dice);
    Vec3 normal = dice.direction();
    const auto steps = closed_motion<Vec3>(1e-3, dice, [&] { return dice.direction(); });
    FrictionMemory<Vec3> memory;
    Load load(dice);
    double work_J = 0.0;
    for (const Vec3& step : steps) {
      const double bend = dice.one_in(10) ? 10.0 : dice.decades(-6.0, -1.0);
      const Vec3 next = (normal + bend * dice.direction()).normalized();
      memory.elastic_force_N = rendering::turned(memory.elastic_force_N, normal, next);
      normal = next;
      // A step nearly along the normal leaves little, much of it rounding: so it is projected
      // twice.
      const Vec3 way = tangential(tangential(step, normal), normal);
      work_J += update_friction(friction, memory, way, load.next(), 1e-3).mean_force_N.dot(way);
      worst.given_out_J = std::max(worst.given_out_J, stored_J(friction, memory) - work_J);
      ASSERT_NEAR(memory.elastic_force_N.dot(normal), 0.0, 1e-12);
    }
    worst.friction_J += work_J;
  }
  expect_passive(worst);
}

// Returns the numbers of all registered models.
std::vector<FrictionKind> all_kinds() {
  std::vector<FrictionKind> kinds;
  std::ranges::transform(rendering::kFrictionModels, std::back_inserter(kinds),
                         &rendering::FrictionModelTraits::kind);
  return kinds;
}

std::string name_of(const ::testing::TestParamInfo<FrictionKind>& kind) {
  return std::string(rendering::kFrictionModels.at(static_cast<std::size_t>(kind.param)).name);
}

INSTANTIATE_TEST_SUITE_P(Kinds, FrictionEnergy, ::testing::ValuesIn(all_kinds()), name_of);

}  // namespace
}  // namespace tactus::testing
