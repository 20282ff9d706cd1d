// A controller that restores another's state goes on to the same bits, over every kind of surface
// and contact that needs no baking.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <random>
#include <vector>

#include "tests/property/wanderer.h"
#include "tests/replay/restore_check.h"
#include "tests/support/connected_solid.h"
#include "tests/support/materials.h"
#include "tests/support/share.h"
#include "tests/support/solid.h"

namespace tactus::testing {
namespace {

using rendering::ContactMethod;
using rendering::FrictionKind;
using rendering::Motion;
using rendering::Object;
using rendering::Sides;

constexpr std::size_t kTicksAScene = 20'000;
constexpr std::size_t kTicksOfOneScene = 8'000;
constexpr std::size_t kLeastTicksAScene = 1'500;  // with fewer some tools never get to the surface

// A soak begins anew now and then: a scene that moves by itself is out of reach in the end.
void check(const std::vector<Object>& objects, double radius_m, std::uint64_t seed,
           std::span<const rendering::Effect> effects = {}) {
  constexpr std::uint64_t kNextSeed = 1000;
  RestoreTally tally;
  const std::size_t ticks = std::max(kLeastTicksAScene, share_of(kTicksAScene));
  for (std::size_t done = 0; done < ticks; done += kTicksAScene, seed += kNextSeed) {
    ASSERT_NO_FATAL_FAILURE(expect_restores_go_on_alike(
        {.objects = objects, .world = {.tool_radius_m = radius_m, .effects = effects}}, seed,
        std::min(kTicksAScene, ticks - done), tally));
  }
  std::printf("%zu restores in %zu ticks, %zu in contact; %zu bytes at most\n", tally.restores,
              tally.ticks, tally.contacts, tally.most_bytes);
  EXPECT_GT(tally.contacts, tally.ticks / 50);
}

TEST(Restore, GoesOnAlikeOverEveryShapeOfMesh) {
  std::uint64_t seed = 1;
  RestoreTally tally;
  for (const Shape& shape : wandered_shapes()) {
    for (const double radius_m : {0.0, 0.002}) {
      SCOPED_TRACE(shape.name);
      const Solid solid(shape, shape.closed ? Sides::one : Sides::two, kRough);
      ASSERT_NO_FATAL_FAILURE(expect_restores_go_on_alike(
          {.objects = {&solid.object(), 1}, .world = {.tool_radius_m = radius_m}}, seed++,
          std::max(kLeastTicksAScene / 4, share_of(kTicksAScene / 8)), tally));
    }
  }
  EXPECT_GT(tally.contacts, tally.ticks / 10);
}

TEST(Restore, GoesOnAlikeWhereManyTrianglesAreNearEverywhere) {
  // Balls in one another have many triangles everywhere.
  constexpr int kBalls = 32;
  Shape balls = icosphere(0.03, 3);
  for (int k = 1; k < kBalls; ++k) {
    balls = joined(std::move(balls), turned(icosphere(0.03, 3), {1.0, 2.0, 3.0}, 0.1 * k));
  }
  // Felt from inside as well, where the tool is most of the time.
  const Solid solid(balls, Sides::two, kRough);
  check({solid.object()}, 0.004, 500);
}

TEST(Restore, GoesOnAlikeWithEveryFrictionModel) {
  std::uint64_t seed = 130;
  for (std::size_t kind = 0; kind < rendering::kFrictionKinds; ++kind) {
    rendering::Material material = kRough;
    material.friction.kind = static_cast<FrictionKind>(kind);
    material.friction.viscous_s_per_m = 0.05;
    material.friction.stiffness_N_per_m = 800.0;
    const Solid solid(bumpy_sphere(0.04, 3, 0.05), Sides::one, material);
    SCOPED_TRACE(kind);
    check({solid.object()}, 0.002, seed++);
  }
}

TEST(Restore, GoesOnAlikeAmongObjectsThatMoveByThemselves) {
  const Solid ball(icosphere(0.03, 3), Sides::one, kRough);
  const Solid block(box({0.03, 0.04, 0.05}), Sides::one, kRough);
  const Motion sway{.sway_W = {0.02, 0.01, 0.0}, .sway_Hz = 1.7};
  const Motion spin{.spin_W = {0.5, 3.0, 0.2}, .pivot_W = {0.01, 0.0, 0.0}};
  const Motion pass{.velocity_W = {0.001, 0.0, 0.0}};
  std::vector<Object> objects{ball.object(), block.object(), ball.object()};
  objects.push_back(
      {.surface = rendering::SurfaceKind::primitive,
       .primitive = {.kind = rendering::PrimitiveKind::torus, .dimensions_m = {0.03, 0.01, 0.0}},
       .material = kRough});
  const std::array<const Motion*, 4> motions{&sway, &spin, nullptr, &pass};
  for (std::size_t i = 0; i < objects.size(); ++i) {
    objects[i].moves = true;
    objects[i].motion = motions[i];
  }
  check(objects, 0.0, 200);
  check(objects, 0.002, 201);
}

TEST(Restore, GoesOnAlikeOnASheetThatWaves) {
  Object object;
  const Solid sheet(flat_sheet(0.005, 30), Sides::two, kRough);
  const std::vector<rendering::Float3> up(sheet.object().mesh.vertices.size(), {0.0F, 1.0F, 0.0F});
  const Motion waves{.velocity_W = {0.0, 0.0005, 0.0},
                     .wave_m = 0.004,
                     .wave_Hz = 1.0,
                     .wave_per_m = {12.0, 0.0, 0.0}};
  object = sheet.object();
  object.deforms = true;
  object.vertex_normals = up;
  object.motion = &waves;
  check({object}, 0.002, 300);
}

TEST(Restore, GoesOnAlikeOnPrimitivesFieldsAndWalksAndUnderEffects) {
  const ConnectedSolid walked(icosphere(0.03, 3));
  Object walk;
  walk.method = ContactMethod::feature_walk;
  walk.mesh = walked.mesh().mesh;
  walk.neighbours = walked.mesh().neighbours;
  walk.vertex_normals = walked.mesh().vertex_normals;
  walk.material = kRough;
  Object field = walk;
  field.method = ContactMethod::potential_field;
  Object ball{
      .surface = rendering::SurfaceKind::primitive,
      .primitive = {.kind = rendering::PrimitiveKind::sphere, .dimensions_m = {0.03, 0.0, 0.0}},
      .material = kRough};
  ball.primitive.X_WO.translation = {0.05, 0.0, 0.0};
  Object pointed = ball;
  pointed.method = ContactMethod::god_object;
  pointed.primitive.X_WO.translation = {0.0, 0.05, 0.0};
  const std::array<rendering::Effect, 3> effects{
      {{.law = rendering::Spring{.stiffness_N_per_m = 5.0}, .max_force_N = 1.0},
       {.law = rendering::StickSlip{.stiffness_N_per_m = 50.0, .break_force_N = 0.3},
        .max_force_N = 1.0},
       {.law = rendering::Vibration{.amplitude_N = 0.2, .frequency_Hz = 130.0},
        .max_force_N = 1.0}}};
  check({walk, field, ball, pointed}, 0.002, 400, effects);
}

TEST(Restore, GoesOnAlikeByTheTextbooksMethods) {
  const Solid ball(icosphere(0.03, 3), Sides::one, kRough);
  const Solid groove(grooved_block(90.0, 0.02), Sides::one, kRough);
  std::uint64_t seed = 450;
  for (const ContactMethod method : {ContactMethod::one_plane, ContactMethod::three_sub_goals,
                                     ContactMethod::three_step, ContactMethod::one_step}) {
    for (const Solid* const solid : {&ball, &groove}) {
      SCOPED_TRACE(static_cast<int>(method));
      Object object = solid->object();
      object.method = method;
      check({object}, 0.002, seed++);
    }
  }
}

TEST(Restore, HasRoomForTheLargestScene) {
  const auto side = static_cast<int>(std::sqrt(rendering::kMaxDeformableVertices));
  const Solid sheet(flat_sheet(0.002, side - 2), Sides::two, kRough);
  ASSERT_GT(sheet.object().mesh.vertices.size(), rendering::kMaxDeformableVertices * 9 / 10);
  Object ball{
      .surface = rendering::SurfaceKind::primitive,
      .primitive = {.kind = rendering::PrimitiveKind::sphere, .dimensions_m = {0.03, 0.0, 0.0}},
      .material = kRough};
  ball.moves = true;
  std::vector<Object> objects(rendering::kMaxMovers, ball);
  objects.front() = sheet.object();
  objects.front().deforms = true;
  const auto controller = loaded({.objects = objects, .world = {.tool_radius_m = 0.002}});
  SceneWalk walk(objects, 700);
  std::vector<std::byte> bytes(firmware::kMaxCheckpointBytes);
  std::size_t most = 0;
  for (std::size_t tick = 0; tick < 2000; ++tick) {
    give(*controller, walk.next(controller->mode()));
    const std::size_t size = controller->save(bytes);
    ASSERT_GT(size, 0U) << "tick " << tick;
    most = std::max(most, size);
  }
  std::printf("%zu bytes at most\n", most);
}

// A flight recorder saves the controller that runs: what cannot be saved must not cost the run.
TEST(Restore, AStateThatFindsNoRoomIsLeftAsItWas) {
  const Solid ball(icosphere(0.03, 3), Sides::one, kRough);
  const std::array<Object, 2> objects{ball.object(), ball.object()};
  const RestoreScene scene{.objects = objects, .world = {.tool_radius_m = 0.002}};
  const auto saved = loaded(scene);
  const auto alone = loaded(scene);
  std::vector<std::byte> bytes(firmware::kMaxCheckpointBytes);
  std::mt19937_64 random(500);
  SceneWalk walk(objects, 500);
  std::size_t contacts = 0;
  const std::size_t ticks = std::max(kLeastTicksAScene, part_of(kTicksOfOneScene));
  for (std::size_t tick = 0; tick < ticks; ++tick) {
    const std::size_t size = saved->save(bytes);
    ASSERT_GT(size, 0U) << "tick " << tick;
    ASSERT_EQ(saved->save(std::span(bytes).first(static_cast<std::size_t>(random() % size))), 0U)
        << "tick " << tick;
    const TickInput input = walk.next(alone->mode());
    give(*saved, input);
    give(*alone, input);
    ASSERT_EQ(saved->record().state_hash, alone->record().state_hash) << "tick " << tick;
    ASSERT_EQ(saved->mode(), alone->mode()) << "tick " << tick;
    contacts += alone->record().contact != rendering::ContactKind::none ? 1U : 0U;
  }
  EXPECT_GT(contacts, ticks / 50);
}

TEST(Restore, IsThereRightAfterASmallerScene) {
  const Solid ball(icosphere(0.03, 3), Sides::one, kRough);
  const Solid floor(box({0.03, 0.04, 0.05}), Sides::one, kRough);
  const std::array<Object, 2> objects{floor.object(), ball.object()};
  const auto controller = loaded({.objects = objects, .world = {.tool_radius_m = 0.002}});
  SceneWalk walk({&ball.object(), 1}, 600);
  std::vector<std::byte> bytes(firmware::kMaxCheckpointBytes);
  const RestoreScene smaller{.objects = {&floor.object(), 1}, .world = {.tool_radius_m = 0.002}};
  std::size_t swaps = 0;
  const std::size_t ticks = std::max(kLeastTicksAScene, part_of(kTicksOfOneScene));
  for (std::size_t tick = 0; tick < ticks; ++tick) {
    give(*controller, walk.next(controller->mode()));
    if (controller->record().contact == rendering::ContactKind::none ||
        controller->mode() == firmware::Mode::active) {
      continue;
    }
    ASSERT_TRUE(controller->load_scene(smaller.objects, smaller.world));
    const std::size_t size = controller->save(bytes);
    ASSERT_GT(size, 0U) << "tick " << tick;
    ASSERT_TRUE(loaded(smaller)->restore(std::span(bytes).first(size))) << "tick " << tick;
    ASSERT_TRUE(controller->load_scene(objects, smaller.world));
    ++swaps;
  }
  EXPECT_GT(swaps, 0U);
}

// The normal of what held the proxy last stands behind its object and triangle.
TEST(Restore, RefusesAProxyThatNothingHolds) {
  const Solid ball(icosphere(0.03, 3), Sides::one, kRough);
  const std::array<Object, 1> objects{ball.object()};
  const RestoreScene scene{.objects = objects, .world = {.tool_radius_m = 0.002}};
  const auto controller = loaded(scene);
  SceneWalk walk(objects, 800);
  while (controller->record().contact == rendering::ContactKind::none) {
    give(*controller, walk.next(controller->mode()));
  }
  std::vector<std::byte> bytes(firmware::kMaxCheckpointBytes);
  bytes.resize(controller->save(bytes));
  ASSERT_TRUE(loaded(scene)->restore(bytes));
  struct Held {
    std::uint32_t object;
    std::uint32_t triangle;
    std::array<double, 3> normal_W;
  };
  std::size_t refused = 0;
  for (std::size_t place = 0; place + sizeof(Held) <= bytes.size(); ++place) {
    Held held{};
    std::memcpy(&held, bytes.data() + place, sizeof held);
    const auto& [x, y, z] = held.normal_W;
    if (held.object != 0 || held.triangle >= objects[0].mesh.triangles.size() ||
        !(std::abs(x * x + y * y + z * z - 1.0) < 1e-9)) {
      continue;
    }
    std::vector<std::byte> changed = bytes;
    std::memcpy(changed.data() + place, &rendering::kNoObject, sizeof rendering::kNoObject);
    refused += loaded(scene)->restore(changed) ? 0U : 1U;
  }
  EXPECT_EQ(refused, 1U);
}

}  // namespace
}  // namespace tactus::testing
