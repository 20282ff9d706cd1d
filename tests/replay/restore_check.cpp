#include "tests/replay/restore_check.h"

#include <gtest/gtest.h>

namespace tactus::testing {
namespace {

using firmware::Controller;

// A walk of its own, so that a member that restore() forgets holds something else.
void lead_astray(Controller& controller, const RestoreScene& scene, std::uint64_t seed) {
  SceneWalk walk(scene.objects, seed);
  walk.also_set_methods();
  for (int tick = 0; tick < 40; ++tick) {
    const TickInput input = walk.next(controller.mode());
    give(controller, input);
  }
}

}  // namespace

std::unique_ptr<Controller> loaded(const RestoreScene& scene) {
  auto controller = std::make_unique<Controller>();
  EXPECT_TRUE(controller->configure(walking_config()));
  EXPECT_TRUE(controller->load_scene(scene.objects, scene.world));
  return controller;
}

void expect_restores_go_on_alike(const RestoreScene& scene, std::uint64_t seed, std::size_t ticks,
                                 RestoreTally& tally) {
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 random(seed);
  SceneWalk walk(scene.objects, seed);
  walk.also_set_methods();
  const auto first = loaded(scene);
  std::unique_ptr<Controller> second;
  std::vector<std::byte> bytes(firmware::kMaxCheckpointBytes);
  for (std::size_t tick = 0; tick < ticks; ++tick) {
    if (random() % 100 == 0) {
      const std::size_t size = first->save(bytes);
      ASSERT_GT(size, 0U) << "tick " << tick;
      if (second == nullptr || random() % 4 == 0) {
        second = loaded(scene);
      }
      if (random() % 4 != 0) {
        lead_astray(*second, scene, random());
      }
      ASSERT_TRUE(second->restore(std::span(bytes).first(size))) << "tick " << tick;
      ++tally.restores;
      tally.most_bytes = std::max(tally.most_bytes, size);
    }
    const TickInput input = walk.next(first->mode());
    give(*first, input);
    ++tally.ticks;
    tally.contacts += first->record().contact != rendering::ContactKind::none ? 1U : 0U;
    if (second != nullptr) {
      give(*second, input);
      ASSERT_EQ(first->record().state_hash, second->record().state_hash) << "tick " << tick;
    }
  }
}

}  // namespace tactus::testing
