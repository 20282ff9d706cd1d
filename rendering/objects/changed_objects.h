// The objects of a scene whose material or contact method a program has changed. SceneObjects keeps
// them, so that the scene itself stays as it was baked.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "rendering/limits.h"
#include "rendering/objects/object.h"

namespace tactus::rendering {

// At most kMaxChangedObjects copies of objects, beside those of the scene.
class ChangedObjects {
 public:
  ChangedObjects() { clear(); }

  // Forgets all changes.
  void clear() {
    place_of_.fill(kUnchanged);
    count_ = 0;
  }

  // Returns the copy of object `number` < kMaxObjects, to be changed; makes it from `unchanged` the
  // first time. Returns nullptr, and changes nothing, if kMaxChangedObjects others have been
  // changed.
  Object* change(std::uint32_t number, const Object& unchanged) {
    if (place_of_[number] == kUnchanged) {
      if (count_ == kMaxChangedObjects) {
        return nullptr;
      }
      place_of_[number] = static_cast<std::uint8_t>(count_);
      objects_[count_++] = unchanged;
    }
    return &objects_[place_of_[number]];
  }

  // Returns the number of objects that have been changed.
  [[nodiscard]] std::size_t count() const { return count_; }
  // Returns true if object `number` has been changed.
  [[nodiscard]] bool has(std::uint32_t number) const { return place_of_[number] != kUnchanged; }
  // Returns true if object `number` can be changed, once more or for the first time.
  [[nodiscard]] bool has_room_for(std::uint32_t number) const {
    return has(number) || count_ < kMaxChangedObjects;
  }

  // Returns object `number`: the changed one, or `unchanged`. The common case, in which nothing has
  // been changed, costs one comparison.
  [[nodiscard]] const Object& of(std::uint32_t number, const Object& unchanged) const {
    return count_ > 0 && has(number) ? objects_[place_of_[number]] : unchanged;
  }

 private:
  static constexpr std::uint8_t kUnchanged = 0xff;
  static_assert(kMaxChangedObjects < kUnchanged);

  // The place of each object's copy, or kUnchanged; and the copies, the first `count_`.
  std::array<std::uint8_t, kMaxObjects> place_of_;
  std::array<Object, kMaxChangedObjects> objects_{};
  std::size_t count_ = 0;
};

}  // namespace tactus::rendering
