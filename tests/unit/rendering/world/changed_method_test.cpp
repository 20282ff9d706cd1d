// World::set_method with several tools, and with objects that move.
#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <vector>

#include "rendering/world/world.h"

namespace tactus::rendering {
namespace {

Object ball_by_method(double x_m, ContactMethod method) {
  return {.surface = SurfaceKind::primitive,
          .method = method,
          .primitive = {.kind = PrimitiveKind::sphere,
                        .X_WO = {Mat3::Identity(), {x_m, 0.0, 0.0}},
                        .dimensions_m = {0.02, 0.0, 0.0}},
          .material = {.stiffness_N_per_m = 500.0}};
}

TEST(ChangedMethod, IsRefusedWhileAnyToolTouchesTheObject) {
  const std::array objects{ball_by_method(0.0, ContactMethod::sphere_proxy),
                           ball_by_method(0.1, ContactMethod::potential_field)};
  const auto world = std::make_unique<WorldOf<2>>();
  ASSERT_TRUE(world->set_scene(objects, {.tool_radius_m = 0.002, .tool_count = 2}));
  std::array<Touch, 2> touches;
  const auto touch = [&](const Vec3& first, const Vec3& second) {
    world->touch(std::array{ToolState{.p_W = first}, ToolState{.p_W = second}}, touches);
  };
  const Vec3 free{0.0, 0.05, 0.0};
  touch(free, free);
  touch(free, free);
  touch(free, {0.1, 0.015, 0.0});
  ASSERT_EQ(touches[1].contact, ContactKind::face);
  EXPECT_FALSE(world->set_method(1, ContactMethod::god_object));
  EXPECT_EQ(world->object(1).method, ContactMethod::potential_field);
  const Vec3 force_W = touches[1].force_W;
  EXPECT_TRUE(world->set_method(0, ContactMethod::potential_field));
  touch(free, {0.1, 0.015, 0.0});
  EXPECT_EQ(touches[1].force_W, force_W);
  touch(free, free);
  EXPECT_TRUE(world->set_method(1, ContactMethod::god_object));
  EXPECT_EQ(world->unchanged_object(1).method, ContactMethod::potential_field);
}

TEST(ChangedMethod, OfAMovingObjectIsTakenWhereItIs) {
  std::array objects{ball_by_method(0.0, ContactMethod::sphere_proxy)};
  objects[0].moves = true;
  std::array fields = objects;
  fields[0].method = ContactMethod::potential_field;
  const RigidPose place{Mat3::Identity(), {0.05, 0.0, 0.0}};
  const auto changed = std::make_unique<World>();
  const auto baked = std::make_unique<World>();
  ASSERT_TRUE(changed->set_scene(objects, {.tool_radius_m = 0.002}));
  ASSERT_TRUE(baked->set_scene(fields, {.tool_radius_m = 0.002}));
  for (World* const world : {changed.get(), baked.get()}) {
    ASSERT_TRUE(world->set_pose(0, place, {}));
    for (int tick = 0; tick < 3; ++tick) {
      EXPECT_EQ(world->touch({.p_W = {0.05, 0.04, 0.0}}).contact, ContactKind::none);
    }
  }
  ASSERT_TRUE(changed->set_method(0, ContactMethod::potential_field));
  for (int tick = 0; tick < 30; ++tick) {
    const ToolState tool{.p_W = {0.05, 0.03 - 0.0005 * tick, 0.001 * tick}};
    EXPECT_EQ(changed->touch(tool).force_W, baked->touch(tool).force_W) << tick;
  }
  EXPECT_NE(changed->touch({.p_W = {0.05, 0.015, 0.0}}).contact, ContactKind::none);
}

TEST(ChangedMethod, OfManyObjectsEndsAtTheCapacity) {
  const std::vector<Object> objects(kMaxChangedObjects + 1,
                                    ball_by_method(0.0, ContactMethod::god_object));
  const auto world = std::make_unique<World>();
  ASSERT_TRUE(world->set_scene(objects, {}));
  for (std::uint32_t i = 0; i < kMaxChangedObjects; ++i) {
    EXPECT_TRUE(world->set_method(i, ContactMethod::sphere_proxy));
  }
  EXPECT_FALSE(world->set_method(kMaxChangedObjects, ContactMethod::sphere_proxy));
  EXPECT_FALSE(world->set_material(kMaxChangedObjects, {.stiffness_N_per_m = 1.0}));
  EXPECT_TRUE(world->set_method(0, ContactMethod::god_object));
  EXPECT_FALSE(world->set_method(0, ContactMethod::feature_walk)) << "a ball is no mesh";
  EXPECT_FALSE(world->set_method(kMaxChangedObjects + 1, ContactMethod::god_object));
  ASSERT_TRUE(world->set_scene(objects, {}));
  EXPECT_TRUE(world->set_method(kMaxChangedObjects, ContactMethod::sphere_proxy));
}

TEST(ChangedMethod, OfAMeshThatDeformsIsOneOfTheSharedProxy) {
  const Object mesh{.deforms = true};
  for (const NamedContactMethod& method : kContactMethods) {
    EXPECT_EQ(can_render(method.method, mesh, mesh.material), meets_proxy(method.method))
        << method.name;
  }
}

}  // namespace
}  // namespace tactus::rendering
