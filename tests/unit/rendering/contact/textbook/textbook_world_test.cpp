// The textbook's methods on meshes through a World: their force, objects that move, and a state
// that is restored.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include <Eigen/Geometry>

#include "rendering/world/world.h"
#include "tests/support/materials.h"
#include "tests/support/solid.h"

namespace tactus::rendering {
namespace {

using testing::kRough;
using testing::kSlippery;
using testing::Solid;

constexpr std::array kTextbookMethods{ContactMethod::one_plane, ContactMethod::three_sub_goals,
                                      ContactMethod::three_step, ContactMethod::one_step};

// The object by that method.
Object by(Object object, ContactMethod method) {
  object.method = method;
  return object;
}

// A stroke over a ball of 3 cm about the origin, which begins outside.
Vec3 stroke_over_ball(int tick) {
  const double angle = 0.004 * tick;
  const double radius_m = tick == 0 ? 0.04 : 0.028 + 0.001 * std::sin(0.11 * tick);
  return radius_m * Vec3{std::cos(angle) * std::cos(0.3 * angle), std::sin(angle),
                         std::cos(angle) * std::sin(0.3 * angle)};
}

TEST(TextbookMethods, GiveTheStiffnessTimesTheStretch) {
  const Solid sheet(testing::flat_sheet(0.01, 4), Sides::two, kSlippery);
  for (const ContactMethod method : kTextbookMethods) {
    const Object object = by(sheet.object(), method);
    const auto world = std::make_unique<World>();
    ASSERT_TRUE(world->set_scene({&object, 1}, {.tool_radius_m = 0.003}));
    world->touch({.p_W = {0.001, 0.01, 0.002}});
    EXPECT_EQ(world->touch({.p_W = {0.001, 0.001, 0.002}}).contact, ContactKind::none)
        << "the tool is a point";
    const Touch touch = world->touch({.p_W = {0.001, -0.002, 0.002}});
    EXPECT_EQ(touch.contact, ContactKind::face);
    EXPECT_EQ(touch.object, 0U);
    const double depth_m = 0.002 + kDefaultPushOut_m;
    EXPECT_NEAR((touch.force_W - 1000.0 * depth_m * Vec3::UnitY()).norm(), 0.0, 1e-12);
    EXPECT_NEAR(touch.depth_m, depth_m, 1e-15);
    EXPECT_EQ(touch.flags, kTouchClean);
  }
}

TEST(TextbookMethods, KeepContactInTheFrameOfAnObjectThatMoves) {
  const Solid ball(testing::icosphere(0.03, 3), Sides::one, kRough);
  for (const ContactMethod method : kTextbookMethods) {
    SCOPED_TRACE(static_cast<int>(method));
    const Object still = by(ball.object(), method);
    Object moving = still;
    moving.moves = true;
    const auto still_world = std::make_unique<World>();
    const auto moving_world = std::make_unique<World>();
    ASSERT_TRUE(still_world->set_scene({&still, 1}, {.tool_radius_m = 0.0}));
    ASSERT_TRUE(moving_world->set_scene({&moving, 1}, {.tool_radius_m = 0.0}));
    int contacts = 0;
    for (int tick = 0; tick < 600; ++tick) {
      const Vec3 tool_O = stroke_over_ball(tick);
      const Mat3 rotation =
          Eigen::AngleAxisd(0.01 * tick, Vec3(1.0, 2.0, -1.0).normalized()).toRotationMatrix();
      const RigidPose pose{.rotation = rotation, .translation = 5e-4 * tick * Vec3{1.0, -0.5, 0.2}};
      ASSERT_TRUE(moving_world->set_pose(0, pose, {}));
      const Touch expected = still_world->touch({.p_W = tool_O});
      const Touch touch = moving_world->touch({.p_W = pose.rotation * tool_O + pose.translation});
      ASSERT_EQ(touch.contact, expected.contact) << tick;
      ASSERT_EQ(touch.friction, expected.friction) << tick;
      ASSERT_LT((pose.point_in(touch.proxy_W) - expected.proxy_W).norm(), 1e-10) << tick;
      ASSERT_LT((rotation.transpose() * touch.force_W - expected.force_W).norm(), 1e-7) << tick;
      contacts += touch.contact != ContactKind::none ? 1 : 0;
    }
    EXPECT_GT(contacts, 500);
  }
}

TEST(TextbookMethods, AreMetByAnObjectThatSweepsOverAStillTool) {
  const Solid plate(testing::box({0.1, 0.001, 0.1}), Sides::one, kSlippery);
  for (const ContactMethod method : kTextbookMethods) {
    Object object = by(plate.object(), method);
    object.moves = true;
    const auto world = std::make_unique<World>();
    ASSERT_TRUE(world->set_scene({&object, 1}, {.tool_radius_m = 0.0}));
    const Vec3 tool(0.001, 0.0, 0.002);
    Touch touch;
    for (int tick = 0; tick < 20; ++tick) {
      // Three times its thickness in a tick.
      const double middle_m = -0.02 + 0.003 * tick;
      ASSERT_TRUE(
          world->set_pose(0, {.translation = {0.0, middle_m, 0.0}}, {.linear_W = {0.0, 3.0, 0.0}}));
      touch = world->touch({.p_W = tool});
      const double top_m = middle_m + 0.0005;
      ASSERT_EQ(touch.contact != ContactKind::none, top_m > 0.0) << tick;
      ASSERT_NEAR(touch.proxy_W.y(), top_m > 0.0 ? top_m + kDefaultPushOut_m : 0.0, 1e-9);
    }
  }
}

TEST(TextbookMethods, GoOnToTheSameBitsFromASavedContact) {
  const Solid ball(testing::bumpy_sphere(0.03, 3, 0.05), Sides::one, kRough);
  for (const ContactMethod method : kTextbookMethods) {
    // one_step has a tick that finds a facet and one that follows it.
    for (const int saved_at : {100, 101}) {
      SCOPED_TRACE(static_cast<int>(method));
      const Object object = by(ball.object(), method);
      const auto world = std::make_unique<World>();
      const auto other = std::make_unique<World>();
      ASSERT_TRUE(world->set_scene({&object, 1}, {.tool_radius_m = 0.0}));
      ASSERT_TRUE(other->set_scene({&object, 1}, {.tool_radius_m = 0.0}));
      Touch last;
      for (int tick = 0; tick < saved_at; ++tick) {
        last = world->touch({.p_W = stroke_over_ball(tick)});
        other->touch({.p_W = -stroke_over_ball(3 * tick)});
      }
      ASSERT_EQ(last.contact, ContactKind::face);
      std::vector<std::byte> room(1'000'000);
      StateArchive saved = StateArchive::writer(room);
      world->transfer(saved);
      ASSERT_TRUE(saved.good());
      StateArchive restored = StateArchive::reader(std::span(room).first(saved.size()));
      other->transfer(restored);
      ASSERT_TRUE(restored.good());
      ASSERT_TRUE(restored.at_end());
      for (int tick = saved_at; tick < saved_at + 100; ++tick) {
        const Touch expected = world->touch({.p_W = stroke_over_ball(tick)});
        const Touch touch = other->touch({.p_W = stroke_over_ball(tick)});
        ASSERT_EQ(touch.proxy_W, expected.proxy_W) << tick;
        ASSERT_EQ(touch.force_W, expected.force_W) << tick;
        ASSERT_EQ(touch.friction, expected.friction) << tick;
        ASSERT_EQ(touch.contact, expected.contact) << tick;
      }
    }
  }
}

TEST(TextbookMethods, AreRefusedOnSurfacesAndWithDetailThatTheyDoNotKnow) {
  const Solid sheet(testing::flat_sheet(0.01, 4), Sides::two, kSlippery);
  const std::vector<CornerNormals> normals(sheet.object().mesh.triangles.size());
  for (const ContactMethod method : kTextbookMethods) {
    Object object = by(sheet.object(), method);
    EXPECT_TRUE(usable(object)) << "it needs neither neighbours nor vertex normals";
    object.push_out_m = -1e-9;
    EXPECT_FALSE(usable(object));
    object.push_out_m = 0.0;
    EXPECT_TRUE(usable(object));
    object.detail.corner_normals = normals;
    EXPECT_FALSE(usable(object));
    object.detail = {};
    object.deforms = true;
    EXPECT_FALSE(usable(object));
    const Object ball{.surface = SurfaceKind::primitive,
                      .method = method,
                      .primitive = {.kind = PrimitiveKind::sphere, .dimensions_m = {0.03}}};
    EXPECT_FALSE(usable(ball));
  }
  EXPECT_FALSE(usable(by(sheet.object(), ContactMethod::plain_tracking)));
}

}  // namespace
}  // namespace tactus::rendering
