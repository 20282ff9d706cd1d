// The behaviour of the proxy on an implicit surface, case by case.
#include "rendering/contact/implicit_tracking.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "tests/unit/rendering/implicit/implicit_scene.h"

namespace tactus::rendering {
namespace {

constexpr double kRest_m = 1.1e-7;  // and a little: above this height it is not in contact

TEST(ImplicitTracking, MovesWithTheToolInFreeSpace) {
  const FormulaSurface sphere("sphere(1)", 0.03);
  ImplicitTracker tracker;
  tracker.place({0.1, 0.0, 0.0});
  const Vec3 tool{0.05, 0.02, 0.01};
  const ImplicitRest rest = tracker.advance(sphere.surface, kNoFriction, tool);
  EXPECT_LE((rest.proxy_W - tool).norm(), 1e-15);
  EXPECT_EQ(rest.planes, 0);
  EXPECT_EQ(rest.friction, FrictionState::free);
  EXPECT_EQ(rest.normal_W, Vec3(Vec3::Zero()));
}

TEST(ImplicitTracking, BreaksContactWhenTheToolLeavesAndFindsItAgain) {
  const FormulaSurface sphere("sphere(1)", 0.03);
  ImplicitTracker tracker;
  tracker.place({0.0, 0.04, 0.0});
  for (int round = 0; round < 5; ++round) {
    ImplicitRest rest = tracker.advance(sphere.surface, kNoFriction, {0.0, 0.028, 0.0});
    EXPECT_EQ(rest.planes, 1);
    EXPECT_NEAR(rest.proxy_W.y(), 0.03, kRest_m);
    EXPECT_NEAR(rest.normal_W.y(), 1.0, 1e-6);
    EXPECT_NEAR(rest.depth_m, 0.002, kRest_m);
    rest = tracker.advance(sphere.surface, kNoFriction, {0.0, 0.031, 0.0});
    EXPECT_EQ(rest.planes, 0);
    EXPECT_NEAR(rest.proxy_W.y(), 0.031, 1e-15);
  }
}

TEST(ImplicitTracking, CatchesAHalfMillimetreShellCrossedAtTwoMetresPerSecond) {
  // 2 mm a tick: the sampled positions are on both sides of the shell, never within.
  const FormulaSurface shell("shell(sphere(0.03), 0.0005)");
  for (int offset = 0; offset < 20; ++offset) {
    ImplicitTracker tracker;
    const double phase_m = 1e-4 * offset;
    const auto tool_at = [&](int tick) -> Vec3 {
      return {0.0, 0.06 + phase_m - 0.002 * tick, 0.0};
    };
    tracker.place(tool_at(0));
    for (int tick = 1; tick < 28; ++tick) {
      const ImplicitRest rest = tracker.advance(shell.surface, kNoFriction, tool_at(tick));
      EXPECT_GE(rest.proxy_W.norm(), 0.03025);
      if (tool_at(tick).y() < 0.03025) {
        EXPECT_NEAR(rest.proxy_W.norm(), 0.03025, kRest_m);
      }
    }
  }
}

TEST(ImplicitTracking, LetsTheToolOutOfASolidButNotIn) {
  const FormulaSurface sphere("sphere(1)", 0.03);
  ImplicitTracker tracker;
  tracker.place(Vec3::Zero());
  ImplicitRest rest = tracker.advance(sphere.surface, kNoFriction, {0.0, 0.02, 0.0});
  EXPECT_EQ(rest.planes, 0);
  rest = tracker.advance(sphere.surface, kNoFriction, {0.0, 0.04, 0.0});
  EXPECT_EQ(rest.planes, 0);
  rest = tracker.advance(sphere.surface, kNoFriction, {0.0, 0.02, 0.0});
  EXPECT_EQ(rest.planes, 1);
  EXPECT_NEAR(rest.proxy_W.y(), 0.03, kRest_m);
}

TEST(ImplicitTracking, LeavesOneLobeAndIsStoppedByTheNextInTheSameTick) {
  const FormulaSurface pair("union(sphere(1), translate(sphere(1), 2.5, 0, 0))", 0.02);
  ImplicitTracker tracker;
  tracker.place(Vec3::Zero());
  const ImplicitRest rest = tracker.advance(pair.surface, kNoFriction, {0.04, 0.0, 0.0});
  EXPECT_NEAR(rest.proxy_W.x(), 0.03, kRest_m);
  EXPECT_EQ(rest.planes, 1);
}

TEST(ImplicitTracking, KeepsTheToolOnItsSideOfATwoSidedSheet) {
  const FormulaSurface sheet("z - 0.1*sin(3*x)", 0.03, Sides::two);
  for (const double side : {-1.0, 1.0}) {
    ImplicitTracker tracker;
    tracker.place({0.01, 0.0, side * 0.01});
    const ImplicitRest rest =
        tracker.advance(sheet.surface, kNoFriction, {0.012, 0.003, -side * 0.02});
    EXPECT_EQ(rest.planes, 1);
    EXPECT_GE(side * sheet.value_at(rest.proxy_W), 0.0);
    EXPECT_GT(side * rest.normal_W.z(), 0.0);
    EXPECT_GT(rest.depth_m, 0.01);
  }
}

TEST(ImplicitTracking, RestsInTheCreaseOfTwoPlanesAndSlidesAlongIt) {
  // A valley along y: free above both slopes.
  const FormulaSurface valley("min(z - x, z + x)", 0.03);
  ImplicitTracker tracker;
  tracker.place({0.005, 0.0, 0.02});
  ImplicitRest rest = tracker.advance(valley.surface, kNoFriction, {0.001, 0.0, -0.01});
  EXPECT_LE(rest.proxy_W.norm(), 1e-6);
  for (int tick = 1; tick <= 100; ++tick) {
    const double along = 5e-4 * tick;
    rest = tracker.advance(valley.surface, kNoFriction, {0.001, along, -0.01});
    EXPECT_NEAR(rest.proxy_W.y(), along, 1e-6);
    EXPECT_LE(std::abs(rest.proxy_W.x()) + std::abs(rest.proxy_W.z()), 1e-6);
    EXPECT_EQ(rest.flags, kTouchClean);
  }
  EXPECT_EQ(rest.planes, 2);
}

TEST(ImplicitTracking, GoesOverTheEdgeOfABox) {
  const FormulaSurface box("box(2, 2, 2)", 0.02);
  ImplicitTracker tracker;
  tracker.place({0.0, 0.03, 0.0});
  ImplicitRest rest;
  // The tool moves on the top beyond the edge, then down, and in.
  const std::array<Vec3, 4> corners{Vec3{0.0, 0.0195, 0.0}, Vec3{0.022, 0.0195, 0.0},
                                    Vec3{0.022, 0.0155, 0.0}, Vec3{0.0195, 0.0155, 0.0}};
  for (std::size_t leg = 0; leg < 3; ++leg) {
    for (int tick = 0; tick <= 100; ++tick) {
      const Vec3 tool = corners[leg] + 0.01 * tick * (corners[leg + 1] - corners[leg]);
      rest = tracker.advance(box.surface, kNoFriction, tool);
      EXPECT_GE(box.value_at(rest.proxy_W), 0.0);
      EXPECT_EQ(rest.flags, kTouchClean);
    }
  }
  EXPECT_NEAR(rest.proxy_W.x(), 0.02, kRest_m);
  EXPECT_NEAR(rest.proxy_W.y(), 0.0155, 1e-6);
  EXPECT_NEAR(rest.normal_W.x(), 1.0, 1e-9);
}

TEST(ImplicitTracking, PassesTheSingularPointsOfTheHeart) {
  // The gradient vanishes all round the seam at z = 0, and at (0, 0, 1).
  const FormulaSurface heart("heart()", 0.03);
  ImplicitTracker tracker;
  tracker.place({0.05, 0.0, 0.03});
  ImplicitRest rest;
  for (int tick = 0; tick <= 400; ++tick) {
    rest = tracker.advance(heart.surface, kNoFriction, {0.027, 0.003, 0.02 - 1e-4 * tick});
    EXPECT_EQ(rest.flags, kTouchClean);
    EXPECT_GE(heart.value_at(rest.proxy_W), 0.0);
  }
  EXPECT_LT(rest.proxy_W.z(), -0.008) << "it went through the seam";
  tracker.place({0.004, 0.002, 0.06});
  for (int tick = 0; tick <= 400; ++tick) {
    rest = tracker.advance(heart.surface, kNoFriction, {0.004 - 2e-5 * tick, 0.0, 0.027});
    EXPECT_TRUE(rest.proxy_W.allFinite() && rest.normal_W.allFinite());
    EXPECT_GE(heart.value_at(rest.proxy_W), 0.0);
  }
}

TEST(ImplicitTracking, HoldsStillAtASingularPointItself) {
  const FormulaSurface cone("x^2 + y^2 - z^2",
                            0.03);  // both nappes solid along z... outside is a ring
  ImplicitTracker tracker;
  tracker.place({0.02, 0.0, 0.0});
  for (int tick = 0; tick < 10; ++tick) {
    const ImplicitRest rest = tracker.advance(cone.surface, kNoFriction, Vec3::Zero());
    EXPECT_TRUE(rest.proxy_W.allFinite() && rest.normal_W.allFinite());
    EXPECT_GE(cone.value_at(rest.proxy_W), 0.0);
    EXPECT_LE(rest.proxy_W.norm(), 1e-6);
  }
}

TEST(ImplicitTracking, SlipsAtTheAngleOfFrictionOnACurvedSurfaceAtAnySpeed) {
  constexpr double kMu = 0.4;
  const FormulaSurface sphere("sphere(1)", 0.05);
  for (const double speed_m_per_s : {0.001, 0.01, 0.1, 1.0}) {
    ImplicitTracker tracker;
    tracker.place({0.0, 0.06, 0.0});
    ImplicitRest rest;
    Vec3 tool = Vec3::Zero();
    const double distance_m = 0.02;
    const int ticks = static_cast<int>(distance_m / (speed_m_per_s * 1e-3));
    for (int tick = 0; tick <= ticks; ++tick) {
      const double angle = speed_m_per_s * 1e-3 * tick / 0.049;
      tool = 0.049 * Vec3{std::sin(angle), std::cos(angle), 0.0};
      rest = tracker.advance(sphere.surface, rough(kMu, kMu), tool);
    }
    const Vec3 stretch = rest.proxy_W - tool;
    const double normal = stretch.dot(rest.proxy_W.normalized());
    const double tangential = (stretch - normal * rest.proxy_W.normalized()).norm();
    EXPECT_NEAR(tangential / normal, kMu, 0.01 * kMu) << speed_m_per_s;
    EXPECT_EQ(rest.friction, FrictionState::slip);
  }
}

TEST(ImplicitTracking, SticksWithinTheCircleOfStaticFriction) {
  const FormulaSurface ground("y", 0.1);
  ImplicitTracker tracker;
  tracker.place({0.0, 0.01, 0.0});
  tracker.advance(ground.surface, rough(0.8, 0.5), {0.0, -0.005, 0.0});
  ImplicitRest rest = tracker.advance(ground.surface, rough(0.8, 0.5), {0.0039, -0.005, 0.0});
  EXPECT_EQ(rest.friction, FrictionState::stick);
  EXPECT_NEAR(rest.proxy_W.x(), 0.0, 1e-12);
  rest = tracker.advance(ground.surface, rough(0.8, 0.5), {0.0041, -0.005, 0.0});
  EXPECT_EQ(rest.friction, FrictionState::slip);
  EXPECT_NEAR(rest.proxy_W.x(), 0.0041 - 0.5 * 0.005, 1e-6);
}

// The oracle is the model, driven by hand; friction/felt_friction_test.cpp has the other surfaces.
TEST(ImplicitTracking, LagsByAModelsForceOverTheStiffness) {
  const FormulaSurface ground("y", 0.1);
  constexpr Material kBristles{
      .stiffness_N_per_m = 1000.0,
      .friction = {.kind = FrictionKind::dahl, .coulomb = 0.5, .stiffness_N_per_m = 400.0}};
  constexpr double kStep_m = 5e-5;
  ImplicitTracker tracker;
  FrictionMemory<Vec3> memory;
  Vec3 tool(0.0, 0.01, 0.0);
  tracker.place(tool);
  for (int tick = 0; tick < 400; ++tick) {
    const Vec3 step = tick == 0 ? Vec3(0.0, -0.012, 0.0)
                                : Vec3(tick < 200 ? kStep_m : 0.0, 0.0, tick < 200 ? 0.0 : kStep_m);
    tool += step;
    tracker.begin_friction(step, 1e-3);
    const ImplicitRest rest = tracker.advance(ground.surface, kBristles, tool);
    const Vec3 slid = tick == 0 ? Vec3(Vec3::Zero()) : step;
    const auto expected =
        update_friction(kBristles.friction, memory, slid, 1000.0 * rest.depth_m, 1e-3);
    const Vec3 lag = tool - rest.proxy_W;
    ASSERT_NEAR(lag.x(), expected.force_N.x() / 1000.0, 1e-8) << "tick " << tick;
    ASSERT_NEAR(lag.z(), expected.force_N.z() / 1000.0, 1e-8) << "tick " << tick;
  }
}

TEST(ImplicitTracking, FollowsItsSurfaceWhenThatMovesAndTurns) {
  FormulaSurface box("box(1, 0.01, 1)", 0.1);
  ImplicitTracker tracker;
  const Vec3 tool{0.01, 0.02, 0.0};
  tracker.place(tool);
  // A 1 mm plate swept over the still tool at 5 m/s, 5 mm a tick.
  for (int tick = 0; tick < 20; ++tick) {
    box.surface.p_WO = {0.0, 5e-3 * tick, 0.0};
    const ImplicitRest rest = tracker.advance(box.surface, kNoFriction, tool);
    EXPECT_GE(rest.proxy_W.y(), box.surface.p_WO.y() + 0.0005);
    if (box.surface.p_WO.y() > 0.021) {
      EXPECT_NEAR(rest.proxy_W.y(), box.surface.p_WO.y() + 0.0005, kRest_m);
      EXPECT_NEAR(rest.depth_m, rest.proxy_W.y() - tool.y(), 1e-12);
    }
  }
  box.surface.R_WO = Eigen::AngleAxisd(0.3, Vec3::UnitZ()).toRotationMatrix();
  const ImplicitRest rest = tracker.advance(box.surface, kNoFriction, tool);
  EXPECT_NEAR(rest.normal_W.dot(box.surface.R_WO * Vec3::UnitY()), 1.0, 1e-9);
}

TEST(ImplicitTracking, SurvivesAToolThatIsNotANumberOrBeyondTheWorld) {
  const FormulaSurface sphere("sphere(1)", 0.03);
  ImplicitTracker tracker;
  tracker.place({0.0, 0.04, 0.0});
  const ImplicitRest good = tracker.advance(sphere.surface, kNoFriction, {0.0, 0.028, 0.0});
  constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();
  constexpr double kEndless = std::numeric_limits<double>::infinity();
  for (const double bad : {kNotANumber, kEndless, -kEndless, 1e6}) {
    const ImplicitRest rest = tracker.advance(sphere.surface, kNoFriction, {0.0, bad, 0.0});
    EXPECT_EQ(rest.flags, kTouchToolInvalid);
    EXPECT_EQ(rest.planes, 0);
    EXPECT_EQ(rest.proxy_W, good.proxy_W);
    const ImplicitRest again = tracker.advance(sphere.surface, kNoFriction, {0.0, 0.028, 0.0});
    EXPECT_EQ(again.flags, kTouchClean);
    EXPECT_LE((again.proxy_W - good.proxy_W).norm(), 1e-9);
  }
}

TEST(ImplicitTracking, StaysOutOfWhereTheFormulaGivesNoNumber) {
  const FormulaSurface odd("(x/x - 1)/(y/y - 1) + z", 0.03);  // 0/0 everywhere
  ImplicitTracker tracker;
  const Vec3 start{0.01, 0.01, 0.01};
  tracker.place(start);
  for (int tick = 0; tick < 50; ++tick) {
    const ImplicitRest rest = tracker.advance(odd.surface, kNoFriction, {0.01, 0.01, -0.01});
    EXPECT_TRUE(rest.proxy_W.allFinite() && rest.normal_W.allFinite());
    EXPECT_LE((rest.proxy_W - start).norm(), 1e-6);
  }
}

TEST(ImplicitTracking, LeavesAPlaceInFreeSpaceWhereTheGradientVanishes) {
  const FormulaSurface hollow("-sphere(1)", 0.03);
  ImplicitTracker tracker;
  tracker.place(Vec3::Zero());
  tracker.advance(hollow.surface, kNoFriction, Vec3::Zero());
  const Vec3 tool{0.001, 0.002, 0.003};
  const ImplicitRest rest = tracker.advance(hollow.surface, kNoFriction, tool);
  EXPECT_EQ(rest.planes, 0);
  EXPECT_LE((rest.proxy_W - tool).norm(), 1e-15);
}

TEST(ImplicitTracking, EndsOpenAtItsBounds) {
  FormulaSurface ground("y", 0.01);
  ground.surface.bounds_O = {.lower = Vec3::Constant(-1.0), .upper = Vec3::Constant(1.0)};
  ImplicitTracker tracker;
  tracker.place({0.0, 0.005, 0.0});
  ImplicitRest rest = tracker.advance(ground.surface, kNoFriction, {0.0, -0.002, 0.0});
  EXPECT_EQ(rest.planes, 1);
  rest = tracker.advance(ground.surface, kNoFriction, {0.02, -0.002, 0.0});
  EXPECT_EQ(rest.planes, 0);
  EXPECT_LE((rest.proxy_W - Vec3(0.02, -0.002, 0.0)).norm(), 1e-12);
}

TEST(ImplicitTracking, AToolThatJumpsAcrossTheWorldIsStoppedByWhatLiesBetween) {
  const FormulaSurface shell("shell(sphere(0.03), 0.0005)");
  ImplicitTracker tracker;
  tracker.place({-90.0, 0.0, 0.0});
  ImplicitRest rest;
  for (int tick = 0; tick < 10; ++tick) {
    rest = tracker.advance(shell.surface, kNoFriction, {90.0, 0.0, 0.0});
    EXPECT_GE(rest.proxy_W.norm(), 0.03025);
    EXPECT_LT(rest.proxy_W.x(), 0.0);
  }
}

}  // namespace
}  // namespace tactus::rendering
