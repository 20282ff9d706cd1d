// The materials of a scene's objects that a program has changed. SceneObjects keeps them, so that
// the scene itself stays as it was baked.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "rendering/limits.h"
#include "rendering/material/material.h"

namespace tactus::rendering {

// At most kMaxChangedMaterials materials beside those of the scene.
class ChangedMaterials {
 public:
  ChangedMaterials() { clear(); }

  // Forgets all changes.
  void clear() {
    place_of_.fill(kUnchanged);
    count_ = 0;
  }

  // Sets the material of object `number` < kMaxObjects. Returns false, and changes nothing, if
  // kMaxChangedMaterials others have been changed.
  bool set(std::uint32_t number, const Material& material) {
    if (place_of_[number] == kUnchanged) {
      if (count_ == kMaxChangedMaterials) {
        return false;
      }
      place_of_[number] = static_cast<std::uint8_t>(count_++);
    }
    materials_[place_of_[number]] = material;
    return true;
  }

  // Returns the number of objects whose material has been changed.
  [[nodiscard]] std::size_t count() const { return count_; }
  // Returns true if the material of object `number` has been changed.
  [[nodiscard]] bool has(std::uint32_t number) const { return place_of_[number] != kUnchanged; }

  // Returns the material of object `number`: the changed one, or `unchanged`.
  [[nodiscard]] const Material& of(std::uint32_t number, const Material& unchanged) const {
    return has(number) ? materials_[place_of_[number]] : unchanged;
  }

 private:
  static constexpr std::uint8_t kUnchanged = 0xff;
  static_assert(kMaxChangedMaterials < kUnchanged);

  // The place of each object's changed material, or kUnchanged; and the materials, the first
  // `count_`.
  std::array<std::uint8_t, kMaxObjects> place_of_;
  std::array<Material, kMaxChangedMaterials> materials_{};
  std::size_t count_ = 0;
};

}  // namespace tactus::rendering
