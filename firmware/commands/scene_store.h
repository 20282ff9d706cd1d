// The scene in use, and the next one while the loop decides whether to take it: copies of files in
// two rooms of fixed size, checked views, nothing on the heap. Static storage: a megabyte.
//
// One thread: the one that starts the program, then the command thread. The loop only reads what it
// was handed.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <expected>
#include <optional>
#include <span>
#include <string_view>

#include "hal/linux/image_slot.h"
#include "rendering/scene/scene_image.h"

namespace tactus::firmware {

// In words for the user.
struct SceneStoreError {
  std::string_view what;
  int errno_value = 0;  // 0: the file was read, and refused
};

class SceneStore {
 public:
  static constexpr std::size_t kMaxPath = 512;
  static constexpr std::size_t kMaxScene_bytes = std::size_t{256} << 20;

  // The room of each of the two, in place of kMaxScene_bytes. Before the first open_next; pages are
  // had for as much as a scene needs.
  void set_room(std::size_t bytes) { room_bytes_ = bytes; }

  // Copies and checks a file beside the scene in use, which stays. Time grows with the image: 25 ms
  // for 871,200 triangles. Give it up or make it the one in use before the next.
  std::expected<const rendering::SceneImage*, SceneStoreError> open_next(std::string_view path);

  // The loop has taken it: the memory of the one before is given back.
  void use_next();
  // The loop has refused it.
  void drop_next();

  // nullptr without a scene.
  [[nodiscard]] const rendering::SceneImage* scene() const { return scene_of(places_[used_]); }
  // Empty without one.
  [[nodiscard]] std::string_view path() const;
  [[nodiscard]] std::span<const std::byte> bytes() const { return bytes_of(places_[used_]); }
  // Of the one that open_next has opened.
  [[nodiscard]] const rendering::SceneImage* next_scene() const {
    return scene_of(places_[1 - used_]);
  }
  [[nodiscard]] std::span<const std::byte> next_bytes() const {
    return bytes_of(places_[1 - used_]);
  }

  // The first object of that name in the scene in use.
  [[nodiscard]] std::optional<std::uint32_t> find_object(std::string_view name) const;

 private:
  struct Place {
    hal::ImageSlot file;
    std::optional<rendering::SceneImage> image;
    std::array<char, kMaxPath> path{};

    void clear();
  };

  static const rendering::SceneImage* scene_of(const Place& place) {
    return place.image ? &*place.image : nullptr;
  }
  static std::span<const std::byte> bytes_of(const Place& place) { return place.file.bytes(); }
  [[nodiscard]] Place& next() { return places_[1 - used_]; }

  std::array<Place, 2> places_;
  std::size_t used_ = 0;
  std::size_t room_bytes_ = kMaxScene_bytes;
};

}  // namespace tactus::firmware
