#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "tests/unit/rendering/detail/shaded_solid.h"

namespace tactus::rendering {
namespace {

using testing::Hand;
using testing::Picture;

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kStiffness_N_per_m = 1000.0;
constexpr double kWave_m = 0.001;
constexpr double kBump_m = 50e-6;

// The half space below y = 0.
Object ground(const FrictionParameters& friction = {}) {
  return {.surface = SurfaceKind::primitive,
          .primitive = {.kind = PrimitiveKind::plane},
          .material = {.stiffness_N_per_m = kStiffness_N_per_m, .friction = friction}};
}

// Waves along x.
Picture grating() {
  return {{.use = TextureUse::bump,
           .projection = TextureProjection::y,
           .tile_m = kWave_m,
           .high = kBump_m},
          64,
          [](double u, double) { return Vec3::Constant(0.5 + 0.5 * std::cos(kTurn * u)); }};
}

double height(double x) {
  return 0.5 * kBump_m * (std::cos(kTurn * x / kWave_m) - 1.0);
}
double slope(double x) {
  return -0.5 * kBump_m * kTurn / kWave_m * std::sin(kTurn * x / kWave_m);
}

Picture plain(TextureUse use, double grey, double low, double high) {
  return {{.use = use,
           .projection = TextureProjection::triplanar,
           .tile_m = 0.01,
           .low = low,
           .high = high},
          4,
          [grey](double, double) { return Vec3::Constant(grey); }};
}

TEST(BumpTexture, PushesByItsHeightAndAlongItsNormal) {
  const Picture picture = grating();
  Hand hand(picture.on(ground()), 0.0);
  hand.touch({0.0, 0.001, 0.0});
  for (int i = 0; i < 200; ++i) {
    const Vec3 tool{0.00001 * i, -0.0005, 0.0};
    Touch t;
    for (int settle = 0; settle < 10; ++settle) {
      t = hand.touch(tool);
    }
    const double at = t.proxy_W.x();
    EXPECT_NEAR(t.force_W.y(), kStiffness_N_per_m * (0.0005 + height(at)), 1.5e-3) << i;
    EXPECT_NEAR(t.force_W.x() / t.force_W.y(), -slope(at), 0.01) << i;
    EXPECT_NEAR(t.force_W.z(), 0.0, 1e-6);
  }
}

TEST(BumpTexture, IsFeltFromItsOwnSurfaceOn) {
  // In a trough the surface lies kBump_m lower: down to there nothing is felt, and the force grows
  // from nothing.
  const Picture picture = grating();
  Hand hand(picture.on(ground()), 0.0);
  hand.touch({0.5 * kWave_m, 0.001, 0.0});
  for (int i = 0; i < 100; ++i) {
    const double depth = 1e-6 * i;
    const Touch t = hand.touch({0.5 * kWave_m, -depth, 0.0});
    EXPECT_NEAR(t.force_W.y(), kStiffness_N_per_m * std::max(depth - kBump_m, 0.0), 1.5e-3) << i;
  }
}

TEST(BumpTexture, HoldsTheProxyInADeepGroove) {
  // Depth times curvature is 3: plain iteration would swing between the walls without end.
  const Picture picture = grating();
  for (double offset_m = -0.0003; offset_m < 0.0003; offset_m += 0.0001) {
    Hand hand(picture.on(ground()), 0.0);
    const Vec3 tool{0.5 * kWave_m + offset_m, -0.003, 0.0};
    hand.touch({tool.x(), 0.0005, 0.0});
    Touch t;
    for (int i = 0; i < 100; ++i) {
      t = hand.touch({tool.x(), 0.0005 - 0.000035 * (i + 1), 0.0});
    }
    for (int i = 0; i < 50; ++i) {
      t = hand.touch(tool);
    }
    const Touch next = hand.touch(tool);
    EXPECT_LE((next.force_W - t.force_W).norm(), 1e-3) << offset_m;
    EXPECT_NEAR(next.force_W.x() / next.force_W.y(), -slope(next.proxy_W.x()), 0.02) << offset_m;
  }
}

// Returns the forces of one second of a stroke along x at 1 kHz, after half a second of it.
std::vector<Vec3> stroke(const Object& object, double speed_m_per_s, double depth_m) {
  Hand hand(object, 0.0);
  hand.touch({0.0, 0.001, 0.0});
  std::vector<Vec3> forces;
  for (int tick = 0; tick < 1500; ++tick) {
    const Touch t = hand.touch({0.001 * speed_m_per_s * tick, -depth_m, 0.0});
    if (tick >= 500) {
      forces.push_back(t.force_W);
    }
  }
  return forces;
}

// Amplitude at each whole frequency from 1 to 499 Hz, by the sum that defines it.
std::vector<double> spectrum(const std::vector<Vec3>& forces, int axis) {
  std::vector<double> amplitudes{0.0};
  const auto count = static_cast<double>(forces.size());
  for (int hertz = 1; hertz < 500; ++hertz) {
    double cosine = 0.0;
    double sine = 0.0;
    for (std::size_t i = 0; i < forces.size(); ++i) {
      const double angle = kTurn * hertz * static_cast<double>(i) / count;
      cosine += forces[i][axis] * std::cos(angle);
      sine += forces[i][axis] * std::sin(angle);
    }
    amplitudes.push_back(2.0 / count * std::hypot(cosine, sine));
  }
  return amplitudes;
}

TEST(Grating, OfOneMillimetreStrokedAtFiftyMillimetresASecondIsFeltAtFiftyHertz) {
  const Picture picture = grating();
  const std::vector<Vec3> forces = stroke(picture.on(ground()), 0.05, 0.0005);
  for (const int axis : {0, 1}) {
    const std::vector<double> amplitudes = spectrum(forces, axis);
    const auto peak = static_cast<int>(std::ranges::max_element(amplitudes) - amplitudes.begin());
    std::printf("axis %d: peak of %.1f mN at %d Hz, %.1f mN at 100 Hz\n", axis,
                1e3 * amplitudes[static_cast<std::size_t>(peak)], peak, 1e3 * amplitudes[100]);
    EXPECT_EQ(peak, 50);
    for (std::size_t hertz = 1; hertz < amplitudes.size(); ++hertz) {
      if (hertz % 50 != 0) {
        EXPECT_LE(amplitudes[hertz], 0.02 * amplitudes[50]) << hertz << " Hz";
      }
    }
  }
  // The height alone: K times half of black to white.
  EXPECT_NEAR(spectrum(forces, 1)[50], 0.5 * kStiffness_N_per_m * kBump_m, 0.25 * 0.025);
}

TEST(Grating, BeyondTheNyquistLimitFoldsNothingBack) {
  const Picture picture = grating();
  for (const double speed_m_per_s : {0.55, 0.6, 0.9, 1.3, 2.7}) {  // 550 Hz to 2.7 kHz of waves
    const std::vector<Vec3> forces = stroke(picture.on(ground()), speed_m_per_s, 0.0005);
    for (const int axis : {0, 1}) {
      const std::vector<double> amplitudes = spectrum(forces, axis);
      const double worst = *std::ranges::max_element(amplitudes);
      EXPECT_LE(worst, 0.01 * 0.025) << speed_m_per_s << " m/s, axis " << axis;
    }
  }
}

TEST(BumpTexture, IsFeltByAFeatureWalkToo) {
  const Picture picture = grating();
  const testing::ShadedSolid block(testing::moved(testing::box({0.04, 0.04, 0.04}), {0, -0.02, 0}),
                                   40.0, {.stiffness_N_per_m = kStiffness_N_per_m});
  Object object = picture.on(block.shaded());
  object.method = ContactMethod::feature_walk;
  for (const double depth_m : {0.0005, 0.003}) {
    for (double x = 0.0003; x < 0.0008; x += 0.0001) {
      Hand hand(object, 0.0);
      hand.touch({x, 0.0005, 0.0});
      Touch t;
      for (int i = 0; i <= 200; ++i) {
        t = hand.touch({x, 0.0005 - std::min(0.01 * i, 1.0) * (0.0005 + depth_m), 0.0});
      }
      const Touch next = hand.touch({x, -depth_m, 0.0});
      EXPECT_LE((next.force_W - t.force_W).norm(), 2e-3) << depth_m << " " << x;
      EXPECT_NEAR(t.force_W.x() / t.force_W.y(), -slope(t.proxy_W.x()), 0.02)
          << depth_m << " " << x;
      EXPECT_NEAR(t.force_W.y(), kStiffness_N_per_m * (depth_m + height(t.proxy_W.x())), 2e-3);
    }
  }
}

TEST(BumpTexture, GoesWithAnObjectThatMoves) {
  const Picture picture = grating();
  Object object = picture.on(ground());
  object.moves = true;
  const auto world = std::make_unique<World>();
  ASSERT_TRUE(world->set_scene({&object, 1}, {}));
  world->touch({.p_W = {0.0, 0.001, 0.0}});
  for (int i = 0; i < 40; ++i) {
    const double shift = 0.00005 * i;
    world->set_pose(0, {.translation = {shift, 0.002, 0.0}}, {});
    Touch t;
    for (int settle = 0; settle < 10; ++settle) {
      t = world->touch({.p_W = {0.0, 0.0015, 0.0}});
    }
    EXPECT_NEAR(t.force_W.y(), kStiffness_N_per_m * (0.0005 + height(t.proxy_W.x() - shift)),
                1.5e-3);
  }
}

TEST(StiffnessTexture, MultipliesTheStiffness) {
  const Picture picture = plain(TextureUse::stiffness, 0.2, 0.5, 2.5);
  Hand hand(picture.on(ground()), 0.002);
  hand.touch({0.0, 0.01, 0.0});
  const Touch t = hand.touch({0.001, 0.0, 0.002});
  EXPECT_NEAR(t.force_W.y(), 0.9 * kStiffness_N_per_m * t.depth_m, 1e-9);
}

TEST(FrictionTexture, MultipliesBothCoefficients) {
  const Picture picture = plain(TextureUse::friction, 0.4, 0.0, 2.0);
  Hand hand(picture.on(ground(cone_friction(0.5, 0.25))), 0.001);
  hand.touch({0.0, 0.01, 0.0});
  double most = 0.0;
  Touch t;
  for (int i = 0; i < 400; ++i) {
    t = hand.touch({2e-6 * i, 0.0, 0.0});
    most = std::max(most, std::abs(t.force_W.x()) / t.force_W.y());
  }
  EXPECT_NEAR(most, 0.8 * 0.5, 0.003);
  EXPECT_EQ(t.friction, FrictionState::slip);
  EXPECT_NEAR(std::abs(t.force_W.x()) / t.force_W.y(), 0.8 * 0.25, 1e-3);
}

TEST(FrictionTexture, OfABumpFollowsWhatPresses) {
  const Picture picture = plain(TextureUse::bump, 0.0, 0.0, 0.0004);  // black: 0.4 mm lower
  Hand hand(picture.on(ground(cone_friction(0.25, 0.25))), 0.001);
  hand.touch({0.0, 0.01, 0.0});
  Touch t;
  for (int i = 0; i < 400; ++i) {
    t = hand.touch({2e-6 * i, 0.0, 0.0});
  }
  EXPECT_NEAR(t.force_W.y(), kStiffness_N_per_m * 0.0006, 1e-3);
  EXPECT_NEAR(std::abs(t.force_W.x()) / t.force_W.y(), 0.25, 2e-3);
}

TEST(NormalMap, TiltsTheForce) {
  const Vec3 wanted = Vec3(0.3, -0.2, 0.9).normalized();  // right (x), up (-z), out (y)
  const Picture picture({.use = TextureUse::normal,
                         .projection = TextureProjection::y,
                         .format = TextureFormat::rgb,
                         .tile_m = 0.01},
                        4, [&](double, double) { return Vec3{0.5 * (wanted + Vec3::Ones())}; });
  for (const double radius_m : {0.0, 0.002}) {
    Hand hand(picture.on(ground()), radius_m);
    hand.touch({0.0, 0.01, 0.0});
    Touch t;
    for (int i = 0; i < 5; ++i) {
      t = hand.touch({0.0, radius_m - 0.001, 0.0});
    }
    const Vec3 expected{wanted.x(), wanted.z(), -wanted.y()};
    EXPECT_LE((t.force_W.normalized() - expected).norm(), 0.01);
    EXPECT_NEAR(t.force_W.y(), kStiffness_N_per_m * 0.001, 1e-3);
  }
}

TEST(NormalMap, LeansNoMoreThanSixtyDegrees) {
  const Picture picture({.use = TextureUse::normal,
                         .projection = TextureProjection::y,
                         .format = TextureFormat::rgb,
                         .tile_m = 0.01},
                        4, [](double, double) { return Vec3{1.0, 0.5, 0.5}; });
  Hand hand(picture.on(ground()), 0.0);
  hand.touch({0.0, 0.01, 0.0});
  hand.touch({0.0, -0.001, 0.0});
  const Touch t = hand.touch({0.0, -0.001, 0.0});
  EXPECT_NEAR(t.force_W.x() / t.force_W.y(), std::sqrt(3.0), 0.01);
}

TEST(SurfaceDetail, IsRefusedWhereItIsNotSound) {
  const Picture good = plain(TextureUse::stiffness, 0.5, 0.0, 1.0);
  World& world = *std::make_unique<World>().release();
  const std::unique_ptr<World> owner(&world);
  const auto taken = [&](const Object& object) { return world.set_scene({&object, 1}, {}); };
  EXPECT_TRUE(taken(good.on(ground())));
  Object short_of_texels = good.on(ground());
  short_of_texels.detail.texels = short_of_texels.detail.texels.first(5);
  EXPECT_FALSE(taken(short_of_texels));
  EXPECT_FALSE(taken(plain(TextureUse::stiffness, 0.5, -1.0, 1.0).on(ground())));
  EXPECT_FALSE(taken(plain(TextureUse::friction, 0.5, 0.0, std::nan("")).on(ground())));
  EXPECT_FALSE(taken(plain(TextureUse::bump, 0.5, 0.0, 1.0).on(ground())));
  EXPECT_FALSE(taken(plain(TextureUse::normal, 0.5, 0.0, 1.0).on(ground())));
  const std::vector<CornerNormals> corners(1);
  Object shaded_plane = ground();
  shaded_plane.detail.corner_normals = corners;
  EXPECT_FALSE(taken(shaded_plane));
}

}  // namespace
}  // namespace tactus::rendering
