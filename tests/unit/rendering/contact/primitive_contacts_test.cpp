// A sphere that touches one primitive in several points at once comes to rest where all of them
// hold it: in the hole of a torus, and in the corners within a hollow solid. The oracles are closed
// forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>

#include <Eigen/Geometry>

#include "rendering/world/world.h"
#include "tests/support/materials.h"
#include "tests/support/share.h"

namespace tactus::rendering {
namespace {

using testing::kMicron;
using testing::kRough;
using testing::kSlippery;

class PrimitiveContacts : public ::testing::Test {
 protected:
  static constexpr double kTool_m = 0.0065;
  static constexpr int kTicks = 400;
  // How much room a round wall leaves to the sphere's centre.
  static constexpr std::array kRooms_m{1e-6, 3e-6, 1e-5, 1e-4, 1e-3, 1e-2};

  void load(const Primitive& primitive, Sides sides, const Material& material = kSlippery) {
    object_ = {.surface = SurfaceKind::primitive,
               .primitive = primitive,
               .sides = sides,
               .material = material};
    pose_ = primitive.X_WO;
    world_ = std::make_unique<World>();
    ASSERT_TRUE(world_->set_scene({&object_, 1}, {.tool_radius_m = kTool_m}));
  }

  // Moves the tool from p_O to q_O in the frame of the primitive and holds it there. Returns where
  // the proxy is then, and checks that it is at rest.
  Vec3 press(const Vec3& p_O, const Vec3& q_O) {
    Touch last;
    for (int tick = 0; tick <= kTicks; ++tick) {
      const double share = std::min(1.0, tick / (0.5 * kTicks));
      const Touch touch = world_->touch({.p_W = pose_.point(p_O + share * (q_O - p_O))});
      if (tick > kTicks - 20) {
        EXPECT_EQ(touch.flags, kTouchClean);
        EXPECT_LE((touch.proxy_W - last.proxy_W).norm(), 1e-9);
      }
      last = touch;
    }
    return pose_.point_in(last.proxy_W);
  }

  // Strokes round a round wall that leaves the sphere's centre this room, 3 mm beyond it and at up
  // to 1 m/s: `about_O` is the middle of the wall, `u` and `v` are the directions of the circle.
  void expect_to_follow(double room_m, const Vec3& about_O, const Vec3& u, const Vec3& v) {
    constexpr double kBeyond_m = 0.003;
    constexpr double kStep_m = 1e-3;
    constexpr double kExact_m = 0.1e-6;
    const double rest_m = room_m - 0.5e-6;
    const double turn = std::min(kStep_m / (room_m + kBeyond_m), 0.3);
    for (int tick = 0; tick < kTicks; ++tick) {
      const Vec3 out = std::cos(turn * tick) * u + std::sin(turn * tick) * v;
      const double out_m = std::min(room_m + kBeyond_m, 0.25 * kStep_m * tick);
      const Touch touch = world_->touch({.p_W = pose_.point(about_O + out_m * out)});
      const Vec3 exact = pose_.point(about_O + std::min(out_m, rest_m) * out);
      ASSERT_EQ(touch.flags, kTouchClean) << "room " << room_m << ", tick " << tick;
      ASSERT_LE((touch.proxy_W - exact).norm(), kExact_m) << "room " << room_m << ", tick " << tick;
    }
  }

  // Returns a random rotation and a place within a centimetre.
  RigidPose any_pose() {
    const Vec3 axis = Vec3(bell_(random_), bell_(random_), bell_(random_)).normalized();
    return {.rotation = Eigen::AngleAxisd(bell_(random_), axis).toRotationMatrix(),
            .translation = 0.01 * axis};
  }
  double any(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }

  std::mt19937 random_{1};
  std::normal_distribution<double> bell_;
  Object object_;
  RigidPose pose_;
  std::unique_ptr<World> world_;
};

// The torus of the audit: its hole, of 6 mm, is smaller than the sphere, of 6.5 mm.
TEST_F(PrimitiveContacts, ATorusHoldsASphereThatIsLargerThanItsHole) {
  constexpr double kRing_m = 0.008;
  constexpr double kTube_m = 0.002;
  const double rest_m = kTool_m + kTube_m + 0.5e-6;
  const double height_m = std::sqrt(rest_m * rest_m - kRing_m * kRing_m);
  for (const Material& material : {kSlippery, kRough}) {
    for (int press_number = 0; press_number < testing::share_of(60); ++press_number) {
      load({.kind = PrimitiveKind::torus,
            .X_WO = press_number == 0 ? RigidPose{} : any_pose(),
            .dimensions_m = {kRing_m, kTube_m}},
           Sides::one, material);
      const Vec3 aside =
          press_number == 0 ? Vec3::Zero().eval() : Vec3(any(-0.002, 0.002), 0, any(-0.002, 0.002));
      const Vec3 proxy = press(Vec3(0, 0.01, 0) + aside, Vec3(0, any(-0.004, 0.001), 0) + aside);
      if (material.friction.static_level == 0.0) {
        EXPECT_NEAR(std::hypot(proxy.x(), proxy.z()), 0.0, 2.0 * kMicron) << press_number;
        EXPECT_NEAR(proxy.y(), height_m, 2.0 * kMicron) << press_number;
      }
      EXPECT_GE(std::hypot(kRing_m - std::hypot(proxy.x(), proxy.z()), proxy.y()),
                kTool_m + kTube_m)
          << press_number;
    }
  }
}

TEST_F(PrimitiveContacts, ATorusPushesBackWithTheForceOfTheDepth) {
  load({.kind = PrimitiveKind::torus, .dimensions_m = {0.008, 0.002}}, Sides::one,
       {.stiffness_N_per_m = 700.0});
  const Vec3 proxy = press({0, 0.01, 0}, Vec3::Zero());
  EXPECT_NEAR(700.0 * proxy.y(), 2.01, 0.002);
}

TEST_F(PrimitiveContacts, AHollowBoxHoldsTheSphereInItsCorners) {
  const Vec3 half(0.01, 0.012, 0.014);
  const double rest_m = kTool_m + 0.5e-6;
  for (int press_number = 0; press_number < testing::share_of(60); ++press_number) {
    load({.kind = PrimitiveKind::box, .X_WO = any_pose(), .dimensions_m = {0.01, 0.012, 0.014}},
         Sides::two);
    const Vec3 tool(any(-0.015, 0.015), any(-0.015, 0.015), any(-0.015, 0.015));
    const Vec3 room = half - Vec3::Constant(rest_m);
    const Vec3 exact = tool.cwiseMax(-room).cwiseMin(room);
    EXPECT_NEAR((press(Vec3::Zero(), tool) - exact).norm(), 0.0, kMicron) << tool.transpose();
  }
}

TEST_F(PrimitiveContacts, AHollowCylinderHoldsTheSphereAtItsEnds) {
  const double room_m = 0.01 - kTool_m - 0.5e-6;
  for (int press_number = 0; press_number < testing::share_of(60); ++press_number) {
    load({.kind = PrimitiveKind::cylinder, .X_WO = any_pose(), .dimensions_m = {0.01, 0.01}},
         Sides::two);
    const double azimuth = any(0.0, 2.0 * std::numbers::pi);
    const double out = any(0.0, 0.008);
    const Vec3 outward(std::cos(azimuth), 0.0, std::sin(azimuth));
    const double up = any(-0.015, 0.015);
    const Vec3 exact =
        std::min(out, room_m) * outward + std::clamp(up, -room_m, room_m) * Vec3::UnitY();
    const Vec3 proxy = press(Vec3::Zero(), out * outward + up * Vec3::UnitY());
    EXPECT_NEAR((proxy - exact).norm(), 0.0, kMicron) << out << ' ' << up;
  }
}

TEST_F(PrimitiveContacts, AHollowConeHoldsTheSphereBelowItsTip) {
  const double slant_m = std::hypot(0.02, 0.03);
  const double height_m = 0.03 - (kTool_m + 0.5e-6) * slant_m / 0.02;
  for (int press_number = 0; press_number < testing::share_of(60); ++press_number) {
    load({.kind = PrimitiveKind::cone, .X_WO = any_pose(), .dimensions_m = {0.02, 0.03}},
         Sides::two);
    const Vec3 aside(any(-0.001, 0.001), 0, any(-0.001, 0.001));
    const Vec3 proxy = press({0, 0.008, 0}, Vec3(0, any(0.025, 0.03), 0) + aside);
    EXPECT_NEAR(std::hypot(proxy.x(), proxy.z()), 0.0, 2.0 * kMicron) << press_number;
    EXPECT_NEAR(proxy.y(), height_m, 2.0 * kMicron) << press_number;
  }
}

TEST_F(PrimitiveContacts, AHollowSolidFollowsAFastHandHoweverLittleRoomItHas) {
  constexpr double kLength_m = 0.02;
  constexpr double kRing_m = 0.04;
  for (const double room_m : kRooms_m) {
    const double radius_m = kTool_m + room_m;
    for (const PrimitiveKind kind :
         {PrimitiveKind::sphere, PrimitiveKind::capsule, PrimitiveKind::cylinder}) {
      load({.kind = kind, .X_WO = any_pose(), .dimensions_m = {radius_m, kLength_m}}, Sides::two);
      expect_to_follow(room_m, Vec3::Zero(), Vec3::UnitX(), Vec3::UnitZ());
    }
    load({.kind = PrimitiveKind::torus, .X_WO = any_pose(), .dimensions_m = {kRing_m, radius_m}},
         Sides::two);
    expect_to_follow(room_m, kRing_m * Vec3::UnitX(), Vec3::UnitX(), Vec3::UnitY());
  }
}

TEST_F(PrimitiveContacts, TheHoleOfATorusFollowsAFastHandHoweverLittleRoomItHas) {
  constexpr double kTube_m = 0.005;
  for (const double room_m : kRooms_m) {
    load({.kind = PrimitiveKind::torus,
          .X_WO = any_pose(),
          .dimensions_m = {kTool_m + room_m + kTube_m, kTube_m}},
         Sides::one);
    expect_to_follow(room_m, Vec3::Zero(), Vec3::UnitX(), Vec3::UnitZ());
  }
}

// The hand goes to random places about the tip at up to 1 m/s. The proxy is at the tool's
// projection on the cone of its room.
TEST_F(PrimitiveContacts, TheTipOfAHollowConeFollowsAFastHand) {
  constexpr double kRadius_m = 0.02;
  constexpr double kHeight_m = 0.03;
  constexpr double kStep_m = 1e-3;
  const double slant_m = std::hypot(kRadius_m, kHeight_m);
  const double tip_m = kHeight_m - (kTool_m + 0.5e-6) * slant_m / kRadius_m;
  load({.kind = PrimitiveKind::cone, .X_WO = any_pose(), .dimensions_m = {kRadius_m, kHeight_m}},
       Sides::two);
  Vec3 tool(0.0, tip_m - 0.003, 0.0);
  Vec3 target = tool;
  world_->touch({.p_W = pose_.point(tool)});
  for (int tick = 0; tick < testing::share_of(5 * kTicks); ++tick) {
    if ((target - tool).norm() < kStep_m) {
      target = Vec3(any(-0.003, 0.003), tip_m + any(-0.002, 0.004), any(-0.003, 0.003));
    }
    tool += kStep_m * (target - tool).normalized();
    const double r = std::hypot(tool.x(), tool.z());
    const double beyond = (kHeight_m * r + kRadius_m * (tool.y() - tip_m)) / slant_m;
    const double out = r - beyond * kHeight_m / slant_m;
    const double up = tool.y() - beyond * kRadius_m / slant_m;
    Vec3 exact = tool;
    if (beyond > 0.0) {
      exact = out > 0.0 ? Vec3(out / r * tool.x(), up, out / r * tool.z()) : Vec3(0.0, tip_m, 0.0);
    }
    const Touch touch = world_->touch({.p_W = pose_.point(tool)});
    ASSERT_EQ(touch.flags, kTouchClean) << "tick " << tick;
    ASSERT_LE((pose_.point_in(touch.proxy_W) - exact).norm(), kMicron) << "tick " << tick;
  }
}

}  // namespace
}  // namespace tactus::rendering
