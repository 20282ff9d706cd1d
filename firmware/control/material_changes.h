// Materials that were changed while the motors are on, and are still coming in.
//
// A stiffer surface under a pressed tool would push at once as if the hand had gone deeper. Each
// value therefore goes its straight way to the new one by no more than lets the force, at the
// stretch and the speed of the last tick, change by a given step a tick. Where nothing is touched
// the whole change comes in at once.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "rendering/limits.h"
#include "rendering/material/material.h"
#include "rendering/state/state_archive.h"
#include "rendering/world/world.h"

namespace tactus::firmware {

class MaterialChanges {
 public:
  [[nodiscard]] bool any() const { return count_ > 0; }
  void clear() { count_ = 0; }

  // An object of the world, whose material was changed before, shall come to feel like that.
  void set(std::uint32_t object, const rendering::Material& wanted);

  // What the object comes to feel like, or feels like already.
  [[nodiscard]] rendering::Material wanted(const rendering::World& world,
                                           std::uint32_t object) const;

  // Between two ticks: takes the changes on by at most `most_N` in all, at a speed of the tool.
  void step(rendering::World& world, double most_N, double speed_m_per_s);

  // All of them at once.
  void finish(rendering::World& world);

  // What it remembers, to bytes or back; of a world that has been read before.
  void transfer(rendering::StateArchive& archive, const rendering::World& world);

 private:
  struct Change {
    std::uint32_t object = 0;
    rendering::Material wanted;
  };
  std::array<Change, rendering::kMaxChangedMaterials> changes_{};
  std::size_t count_ = 0;
};

}  // namespace tactus::firmware
