// The textbook's tracker of implicit surfaces with its faults: its limit cycle by closed form, the
// incorrect break, thin sheets, and where it begins and ends; beside the tracker without them.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "rendering/contact/textbook/plain_tracking.h"
#include "rendering/limits.h"
#include "rendering/world/world.h"
#include "tests/unit/rendering/implicit/implicit_scene.h"

namespace tactus::rendering {
namespace {

constexpr double kTrackedBall_m = 0.03;

// A point of the plane y = 0 at an angle from the z axis.
Vec3 on_ray(double angle, double radius_m) {
  return radius_m * Vec3{std::sin(angle), 0.0, std::cos(angle)};
}

double ray_of(const Vec3& p) {
  return std::atan2(p.x(), p.z());
}

Object plainly_tracked(const FormulaSurface& formula) {
  return {.surface = SurfaceKind::implicit,
          .method = ContactMethod::plain_tracking,
          .implicit = formula.surface,
          .sides = formula.surface.sides,
          .material = kNoFriction};
}

// A world with one formula, and a tool that has begun at `start`.
class TrackedWorld {
 public:
  TrackedWorld(const FormulaSurface& formula, const Vec3& start)
      : object_(plainly_tracked(formula)) {
    EXPECT_TRUE(world->set_scene({&object_, 1}, {.tool_radius_m = 0.0}));
    touch(start);
  }
  TrackedWorld(const TrackedWorld&) = delete;
  TrackedWorld& operator=(const TrackedWorld&) = delete;
  ~TrackedWorld() = default;

  Touch touch(const Vec3& tool) const { return world->touch({.p_W = tool}); }

  std::unique_ptr<World> world = std::make_unique<World>();

 private:
  Object object_;
};

TEST(PlainTracker, MultipliesTheAngleByMinusDepthOverRadiusInAHollow) {
  const FormulaSurface hollow("-sphere(1)", kTrackedBall_m);
  constexpr double kSmallAngle = 1e-4;
  for (const double ratio : {0.1, 0.5, 0.9, 1.1, 1.5}) {
    SCOPED_TRACE(ratio);
    TrackedWorld world(hollow, on_ray(kSmallAngle, 0.9 * kTrackedBall_m));
    world.touch(on_ray(kSmallAngle, 1.001 * kTrackedBall_m));
    double angle = kSmallAngle;
    for (int tick = 0; tick < 5; ++tick) {
      const Touch touch = world.touch({0.0, 0.0, (1.0 + ratio) * kTrackedBall_m});
      ASSERT_EQ(touch.contact, ContactKind::face);
      EXPECT_NEAR(ray_of(touch.proxy_W), -ratio * angle, 1e-5 * kSmallAngle) << tick;
      angle = ray_of(touch.proxy_W);
    }
  }
}

TEST(PlainTracker, SwingsBetweenTwoPlacesBeyondTheRadiusOfAHollowAndSettlesWithinIt) {
  const FormulaSurface hollow("-sphere(1)", kTrackedBall_m);
  constexpr int kTicks = 2000;
  for (const double ratio : {0.3, 0.8, 1.2, 1.5}) {
    SCOPED_TRACE(ratio);
    TrackedWorld world(hollow, on_ray(0.3, 0.9 * kTrackedBall_m));
    world.touch(on_ray(0.3, 1.001 * kTrackedBall_m));
    const double reach = 1.0 + ratio;
    std::array<Touch, 2> last;
    for (std::size_t tick = 0; tick < kTicks; ++tick) {
      last[tick % 2] = world.touch({0.0, 0.0, reach * kTrackedBall_m});
    }
    // A step takes the angle a to a - atan(reach sin a), which swings where tan 2a = reach sin a.
    const double cosine = (1.0 + std::sqrt(1.0 + 2.0 * reach * reach)) / (2.0 * reach);
    const double swing = ratio > 1.0 ? std::acos(cosine) : 0.0;
    EXPECT_NEAR(std::abs(ray_of(last[0].proxy_W)), swing, 1e-6);
    EXPECT_NEAR(ray_of(last[1].proxy_W), -ray_of(last[0].proxy_W), 1e-6);
    // The force of a still tool swings with it.
    EXPECT_NEAR((last[1].force_W - last[0].force_W).norm(),
                2.0 * kNoFriction.stiffness_N_per_m * kTrackedBall_m * std::sin(swing), 1e-4);
  }
}

TEST(PlainTracker, LetsGoForATickInsideAConcaveCornerWhereTrackingHolds) {
  // Solid below y = 0, and to the right of x = 0.
  const FormulaSurface corner("min(y, -x)", 0.1);
  const std::array<Vec3, 4> path{Vec3{-0.02, 0.01, 0.0}, Vec3{-0.02, -0.005, 0.0},
                                 Vec3{0.003, 0.004, 0.0}, Vec3{0.003, 0.004, 0.0}};
  PlainTracker plain;
  ImplicitTracker tracker;
  plain.place(path[0]);
  tracker.place(path[0]);
  constexpr std::array kPlainHolds{false, true, false, true};
  for (std::size_t tick = 0; tick < path.size(); ++tick) {
    const PlainRest rest = plain.advance(corner.surface, path[tick]);
    EXPECT_EQ(rest.in_contact, kPlainHolds[tick]) << tick;
    EXPECT_EQ(rest.flags, kTouchClean);
    EXPECT_EQ(tracker.advance(corner.surface, kNoFriction, path[tick]).planes > 0, tick > 0)
        << tick;
    if (!rest.in_contact) {
      EXPECT_EQ(rest.proxy_W, path[tick]);
      EXPECT_EQ(rest.depth_m, 0.0);
    }
  }
  EXPECT_LT(corner.value_at(path[2]), 0.0) << "the tool is inside in the tick without contact";
  EXPECT_LT((plain.position_W() - Vec3(0.0, 0.004, 0.0)).norm(), 1e-12) << "on the other face";
}

TEST(PlainTracker, PassesAThinSheetInOneTickWhereTrackingHolds) {
  const FormulaSurface sheet("abs(y) - 0.01", 0.1);  // 2 mm thick
  for (const double step_m : {0.0015, 0.003, 0.02}) {
    SCOPED_TRACE(step_m);
    PlainTracker plain;
    ImplicitTracker tracker;
    const Vec3 above(0.0, 0.5 * step_m, 0.0);
    const Vec3 below(0.0, -0.5 * step_m, 0.0);
    plain.place({0.0, 0.02, 0.0});
    tracker.place({0.0, 0.02, 0.0});
    const bool is_felt = plain.advance(sheet.surface, above).in_contact;
    EXPECT_EQ(is_felt, 0.5 * step_m < 0.001) << "above is within the sheet";
    EXPECT_EQ(plain.advance(sheet.surface, below).in_contact, is_felt);
    tracker.advance(sheet.surface, kNoFriction, above);
    const ImplicitRest rest = tracker.advance(sheet.surface, kNoFriction, below);
    EXPECT_EQ(rest.planes, 1);
    EXPECT_NEAR(rest.proxy_W.y(), 0.001, 1e-6);
  }
}

TEST(PlainTracker, LeavesAToolThatBeginsInsideAloneUntilItIsClear) {
  const FormulaSurface ball("sphere(1)", kTrackedBall_m);
  TrackedWorld world(ball, on_ray(0.0, 0.5 * kTrackedBall_m));
  for (const double share : {0.5, 0.9, 0.2, 0.999}) {
    const Touch inside = world.touch(on_ray(0.1, share * kTrackedBall_m));
    EXPECT_EQ(inside.flags, kTouchOverlap);
    EXPECT_EQ(inside.contact, ContactKind::none);
    EXPECT_EQ(inside.force_W, Vec3::Zero());
  }
  const Touch outside = world.touch(on_ray(0.1, 1.01 * kTrackedBall_m));
  EXPECT_EQ(outside.flags, kTouchClean);
  EXPECT_EQ(outside.contact, ContactKind::none);
  const Touch back = world.touch(on_ray(0.1, 0.9 * kTrackedBall_m));
  EXPECT_EQ(back.contact, ContactKind::face);
  EXPECT_NEAR(back.depth_m, 0.1 * kTrackedBall_m, 1e-12);
  EXPECT_LT((back.normal_W - on_ray(0.1, 1.0)).norm(), 1e-12);
  EXPECT_NEAR(back.force_W.norm(), kNoFriction.stiffness_N_per_m * 0.1 * kTrackedBall_m, 1e-9);
}

TEST(PlainTracker, FeelsATwoSidedSheetFromBothSides) {
  const FormulaSurface sheet("y", 0.1, Sides::two);
  for (const double side : {1.0, -1.0}) {
    SCOPED_TRACE(side);
    PlainTracker tracker;
    tracker.place({0.0, 0.01 * side, 0.0});
    EXPECT_FALSE(tracker.advance(sheet.surface, {0.0, 0.005 * side, 0.0}).in_contact);
    for (int tick = 0; tick < 10; ++tick) {
      const Vec3 tool(0.001 * tick, -0.002 * side, 0.0);
      const PlainRest rest = tracker.advance(sheet.surface, tool);
      EXPECT_TRUE(rest.in_contact);
      EXPECT_LT((rest.proxy_W - Vec3(tool.x(), 0.0, 0.0)).norm(), 1e-12);
      EXPECT_EQ(rest.normal_W, Vec3(0.0, side, 0.0));
      EXPECT_NEAR(rest.depth_m, 0.002, 1e-12);
    }
    EXPECT_FALSE(tracker.advance(sheet.surface, {0.0, 0.001 * side, 0.0}).in_contact);
  }
}

TEST(PlainTracker, HasNoSurfaceOutsideItsBox) {
  FormulaSurface sheet("y", 0.1, Sides::two);
  sheet.surface.bounds_O = {.lower = Vec3::Constant(-1.0), .upper = Vec3::Constant(1.0)};
  for (const double side : {1.0, -1.0}) {
    SCOPED_TRACE(side);
    PlainTracker tracker;
    tracker.place({0.0, 0.05 * side, 0.0});
    // It leaves the box, goes round the sheet's end, and comes in on the other side.
    const std::vector<Vec3> path{{0.0, 0.02 * side, 0.0},   {0.0, 0.12 * side, 0.0},
                                 {0.0, 0.15 * side, 0.0},   {0.12, 0.05 * side, 0.0},
                                 {0.12, -0.05 * side, 0.0}, {0.05, -0.05 * side, 0.0}};
    for (const Vec3& tool : path) {
      EXPECT_FALSE(tracker.advance(sheet.surface, tool).in_contact) << tool.transpose();
    }
    const PlainRest rest = tracker.advance(sheet.surface, {0.05, 0.01 * side, 0.0});
    EXPECT_TRUE(rest.in_contact);
    EXPECT_EQ(rest.normal_W, Vec3(0.0, -side, 0.0));
  }
}

TEST(PlainTracker, KeepsItsPointForAToolThatIsNotInTheWorld) {
  const FormulaSurface ball("sphere(1)", kTrackedBall_m);
  PlainTracker tracker;
  tracker.place(on_ray(0.0, 1.1 * kTrackedBall_m));
  const PlainRest held = tracker.advance(ball.surface, on_ray(0.0, 0.9 * kTrackedBall_m));
  ASSERT_TRUE(held.in_contact);
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  for (const Vec3& tool : {Vec3(kNan, 0.0, 0.0), Vec3(0.0, 2.0 * kWorldBound_m, 0.0)}) {
    const PlainRest rest = tracker.advance(ball.surface, tool);
    EXPECT_EQ(rest.flags, kTouchToolInvalid);
    EXPECT_EQ(rest.proxy_W, held.proxy_W);
    EXPECT_FALSE(rest.in_contact);
  }
  EXPECT_TRUE(tracker.advance(ball.surface, on_ray(0.1, 0.9 * kTrackedBall_m)).in_contact);
}

TEST(PlainTracker, GoesOnToTheSameBitsFromASavedContact) {
  const FormulaSurface hollow("-sphere(1)", kTrackedBall_m);
  TrackedWorld world(hollow, on_ray(0.3, 0.9 * kTrackedBall_m));
  const auto tool = [](int tick) {
    return on_ray(0.05 * tick, (2.2 + 0.1 * (tick % 3)) * kTrackedBall_m);
  };
  for (int tick = 0; tick < 25; ++tick) {
    ASSERT_EQ(world.touch(tool(tick)).contact, ContactKind::face);
  }
  std::vector<std::byte> room(1'000'000);
  StateArchive saved = StateArchive::writer(room);
  world.world->transfer(saved);
  ASSERT_TRUE(saved.good());
  TrackedWorld other(hollow, on_ray(2.0, 0.5 * kTrackedBall_m));
  StateArchive restored = StateArchive::reader(std::span(room).first(saved.size()));
  other.world->transfer(restored);
  ASSERT_TRUE(restored.good());
  for (int tick = 25; tick < 75; ++tick) {
    const Touch expected = world.touch(tool(tick));
    const Touch touch = other.touch(tool(tick));
    ASSERT_EQ(touch.proxy_W, expected.proxy_W) << tick;
    ASSERT_EQ(touch.force_W, expected.force_W) << tick;
    ASSERT_EQ(touch.contact, ContactKind::face);
  }
}

}  // namespace
}  // namespace tactus::rendering
