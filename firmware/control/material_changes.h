// Applies changes of materials gradually while the motors are on. One thread; real time.
//
// A stiffer surface under a pressed tool would push at once as if the hand had gone deeper.
// Therefore each value moves linearly to the new one, in steps that change the force by no more
// than a given amount per tick, for the stretch and speed of the last tick. Without contact the
// whole change is applied at once.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "rendering/limits.h"
#include "rendering/material/material.h"
#include "rendering/state_archive.h"
#include "rendering/world/world.h"

namespace tactus::firmware {

// The changes that are not complete yet.
class MaterialChanges {
 public:
  // Returns true if a change is not complete.
  [[nodiscard]] bool any() const { return count_ > 0; }
  // Forgets the changes and leaves the materials as they are.
  void clear() { count_ = 0; }

  // Forgets the change of an object and leaves its material as it is.
  void forget(std::uint32_t object);

  // Sets the material that the object shall get. The object must be among the world's changed ones.
  void set(std::uint32_t object, const rendering::Material& wanted);

  // Returns the material that the object shall get, or has already.
  [[nodiscard]] rendering::Material wanted(const rendering::World& world,
                                           std::uint32_t object) const;

  // Advances the changes so that the force changes by at most `most_N` in all. `speed_m_per_s` is
  // the tool's speed. Call between two ticks.
  void step(rendering::World& world, double most_N, double speed_m_per_s);

  // Completes all changes at once.
  void finish(rendering::World& world);

  // Writes its memory to the archive, or reads it back. `world` must have been read before.
  void transfer(rendering::StateArchive& archive, const rendering::World& world);

 private:
  struct Change {
    std::uint32_t object = 0;
    rendering::Material wanted;
  };
  std::array<Change, rendering::kMaxChangedObjects> changes_{};
  std::size_t count_ = 0;
};

}  // namespace tactus::firmware
