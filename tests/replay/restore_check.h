// A controller that is saved at random ticks, and another one that goes on from there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "firmware/control/controller.h"
#include "tests/replay/scene_walk.h"

namespace tactus::testing {

struct RestoreScene {
  std::span<const rendering::Object> objects;
  rendering::WorldConfig world;
};

// A new controller with walking_config() and the scene.
std::unique_ptr<firmware::Controller> loaded(const RestoreScene& scene);

struct RestoreTally {
  std::size_t ticks = 0;
  std::size_t contacts = 0;
  std::size_t restores = 0;
  std::size_t most_bytes = 0;
};

// Walks for so many ticks. Every hundred ticks or so a second controller, which has been somewhere
// else, takes over the state of the first; from then on both must give the same hash in every tick.
void expect_restores_go_on_alike(const RestoreScene& scene, std::uint64_t seed, std::size_t ticks,
                                 RestoreTally& tally);

}  // namespace tactus::testing
