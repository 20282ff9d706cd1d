// The proxy under a tool that wanders at random over many shapes: never behind the surface, never
// through a shell, and at rest nowhere nearer to the tool could be had.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "rendering/contact/first_crossing.h"
#include "tests/support/share.h"
#include "tests/unit/rendering/implicit/implicit_scene.h"

namespace tactus::rendering {
namespace {

constexpr std::uint64_t kWanderingSeed = 20260321;
constexpr double kWanderingScale_m = 0.03;

int ticks() {
  return std::max(4'000, testing::share_of(20'000));
}

// Goes to random places about the shape at random speeds, trembling; jumps now and then.
class Wanderer {
 public:
  explicit Wanderer(std::uint64_t seed) : random_(seed) {}

  Vec3 next() {
    if (ticks_left_-- <= 0) {
      target_ = 1.4 * kWanderingScale_m * direction();
      speed_m_ = std::pow(10.0, -6.0 + 4.5 * unit_(random_));
      ticks_left_ = 1 + static_cast<int>(300.0 * unit_(random_));
      jumps_ = unit_(random_) < 0.05;
    }
    const Vec3 motion = target_ - tool_;
    const double distance = motion.norm();
    if (jumps_) {
      tool_ = target_;
    } else if (distance > 0.0) {
      tool_ += std::min(1.0, speed_m_ / distance) * motion;
    }
    return tool_ + 0.1 * speed_m_ * direction();
  }

 private:
  Vec3 direction() {
    const auto signed_unit = [&] { return 2.0 * unit_(random_) - 1.0; };
    return {signed_unit(), signed_unit(), signed_unit()};
  }

  std::mt19937_64 random_;
  std::uniform_real_distribution<double> unit_{0.0, 1.0};
  Vec3 tool_ = Vec3::Zero();
  Vec3 target_ = Vec3::Zero();
  double speed_m_ = 0.0;
  int ticks_left_ = 0;
  bool jumps_ = false;
};

// A shape with cusps, in whose bottom no double tells free from solid, or where sheets cross: more
// ticks may say that they could not finish.
enum class Ground { regular, singular };

struct Case {
  const char* text;
  Sides sides;
  Ground ground = Ground::regular;
};

// Prints a parameter in messages of GoogleTest.
void PrintTo(const Case& shape, std::ostream* out) {
  *out << shape.text;
}

class Wandering : public ::testing::TestWithParam<Case> {};

// Returns true if a short free move would bring a proxy at rest much nearer to the tool.
bool could_do_better(const FormulaSurface& shape, double side, const ImplicitRest& rest,
                     const Vec3& tool, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  constexpr double kStep_m = 2e-5;
  ImplicitField field(shape.surface, side, 1'000'000);
  const Vec3 from = shape.surface.to_object(rest.proxy_W);
  for (int i = 0; i < 8; ++i) {
    const Vec3 to_W =
        rest.proxy_W + kStep_m * Vec3{normal(random), normal(random), normal(random)}.normalized();
    const double gain = (rest.proxy_W - tool).norm() - (to_W - tool).norm();
    if (gain > 0.1 * kStep_m &&
        first_crossing(field, from, shape.surface.to_object(to_W), 10'000).state ==
            SegmentState::free) {
      return true;
    }
  }
  return false;
}

TEST_P(Wandering, KeepsTheProxyOnItsSideAndBringsItToRestNearTheTool) {
  const FormulaSurface shape(GetParam().text, kWanderingScale_m, GetParam().sides);
  SCOPED_TRACE(kWanderingSeed);
  Wanderer wanderer(kWanderingSeed);
  std::mt19937_64 random(kWanderingSeed);
  ImplicitTracker tracker;
  const Vec3 start{0.0, 0.0, 3.0 * kWanderingScale_m};
  tracker.place(start);
  double side = shape.value_at(start) < 0.0 ? -1.0 : 1.0;
  int contact = 0;
  int flagged = 0;
  int short_of = 0;
  for (int tick = 0; tick < ticks(); ++tick) {
    const Vec3 tool = wanderer.next();
    const ImplicitRest rest = tracker.advance(shape.surface, kNoFriction, tool);
    ASSERT_TRUE(rest.proxy_W.allFinite() && rest.normal_W.allFinite()) << "tick " << tick;
    ASSERT_GE(side * shape.value_at(rest.proxy_W), -1e-12) << "tick " << tick;
    flagged += rest.flags != kTouchClean ? 1 : 0;
    if (rest.planes == 0) {
      continue;
    }
    ++contact;
    ASSERT_NEAR(rest.normal_W.norm(), 1.0, 1e-9);
    if (rest.flags == kTouchClean && could_do_better(shape, side, rest, tool, random)) {
      ++short_of;
    }
  }
  RecordProperty("contact", contact);
  RecordProperty("flagged", flagged);
  RecordProperty("short_of", short_of);
  EXPECT_GT(contact, ticks() / 20);
  EXPECT_LE(flagged, GetParam().ground == Ground::regular ? contact / 1000 : contact);
  EXPECT_LE(short_of, contact / 1000);
}

// Within the bottle, from one wall into the groove where the neck comes through it, and then along
// the groove: its bottom is a curve of singular points.
TEST(Crossing, OfTwoSheetsDoesNotCatchTheProxy) {
  const FormulaSurface bottle("scale(klein_bottle(), 0.4)", kWanderingScale_m);
  std::mt19937_64 random(kWanderingSeed);
  const auto near = [&](const Vec3& p) {
    std::uniform_real_distribution<double> aside(-0.0015, 0.0015);
    return Vec3{p + Vec3{aside(random), aside(random), aside(random)}};
  };
  constexpr int kPulls = 12;
  for (int k = 0; k < std::max(40, testing::part_of(200)); ++k) {
    ImplicitTracker tracker;
    tracker.place({-0.01046, 0.01172, 0.00751});
    for (const Vec3& on_the_path : {Vec3{-0.0234, 0.0175, 0.033}, Vec3{-0.0122, 0.0246, 0.0212},
                                    Vec3{-0.0024, 0.0321, 0.0081}}) {
      tracker.advance(bottle.surface, kNoFriction, on_the_path);
    }
    const Vec3 over = near({0.0015, 0.0345, 0.004});
    const Vec3 along = near({0.0085, 0.039, -0.004});
    for (int pull = 0; pull < kPulls; ++pull) {
      const Vec3 tool = over + std::min(1.0, pull / 3.0) * (along - over);
      const ImplicitRest rest = tracker.advance(bottle.surface, kNoFriction, tool);
      ASSERT_GE(bottle.value_at(rest.proxy_W), 0.0) << "run " << k << " pull " << pull;
      ASSERT_FALSE(rest.flags == kTouchClean && could_do_better(bottle, 1.0, rest, tool, random))
          << "run " << k << " pull " << pull;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Shapes, Wandering,
    ::testing::Values(Case{"sphere(1)", Sides::one}, Case{"shell(sphere(1), 0.01)", Sides::one},
                      Case{"sphere(1)", Sides::two}, Case{"torus(0.9, 0.3)", Sides::one},
                      Case{"heart()", Sides::one, Ground::singular},
                      Case{"heart()", Sides::two, Ground::singular},
                      Case{"intersection(barth_sextic(), sphere(1.6))", Sides::one,
                           Ground::singular},
                      Case{"klein_bottle()", Sides::two, Ground::singular},
                      Case{"scale(klein_bottle(), 0.4)", Sides::one, Ground::singular},
                      Case{"scale(gyroid(), 0.3)", Sides::two},
                      Case{"scale(shell(gyroid(), 0.1), 0.3)", Sides::one},
                      Case{"scale(quartic(), 0.5)", Sides::one}, Case{"box(1.5, 1, 2)", Sides::one},
                      Case{"difference(box(2,2,2), cylinder(0.5,3))", Sides::one},
                      Case{"union(box(2,0.3,2), rotate(box(2,0.3,2),1,1,0,50))", Sides::one},
                      Case{"box(3, 0.003, 3)", Sides::one}, Case{"capsule(0.4, 1.2)", Sides::one},
                      Case{"cone(1, 1.5)", Sides::one},
                      Case{"blend_union(sphere(.7), translate(sphere(.7),1,0,0), 6)", Sides::one},
                      Case{"sphere(1) + 0.05*sin(15*x)*sin(15*y)*sin(15*z)", Sides::one},
                      Case{"x*y*z", Sides::two}));

}  // namespace
}  // namespace tactus::rendering
