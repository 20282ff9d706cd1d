// Holds the scene in use, and the next one while the loop decides whether to take it. Each is a
// checked copy of a file in a memory block of fixed size; nothing is on the heap. The object
// itself takes a megabyte of static storage.
//
// One thread uses it at a time: first the one that starts the program, then the command thread. The
// loop only reads the image that it was given.
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

// Why a file was not taken.
struct SceneStoreError {
  // The text for the user; it is valid until the next open_next.
  std::string_view what;
  // The errno of the call that failed; 0: the file was read, and refused.
  int errno_value = 0;
};

class SceneStore {
 public:
  // The largest size of a path, with its zero.
  static constexpr std::size_t kMaxPath = 512;
  // The default size of a memory block.
  static constexpr std::size_t kMaxScene_bytes = std::size_t{256} << 20;

  // Sets the size of each memory block; kMaxScene_bytes by default. Call before the first
  // open_next. Memory pages are taken only for the bytes that a scene needs.
  void set_room(std::size_t bytes) { room_bytes_ = bytes; }

  // Copies and checks a file as the next scene; the scene in use stays. The time grows with the
  // size: 25 ms for 871,200 triangles. Returns the scene, which stays valid until drop_next or,
  // after use_next, the use_next that follows. Call use_next or drop_next before the next
  // open_next.
  std::expected<const rendering::SceneImage*, SceneStoreError> open_next(std::string_view path);

  // Makes the next scene the one in use and frees the memory of the previous one. Call after the
  // loop has taken the scene.
  void use_next();
  // Frees the next scene. Call after the loop has refused it.
  void drop_next();

  // Returns the scene in use, or nullptr.
  [[nodiscard]] const rendering::SceneImage* scene() const { return scene_of(places_[used_]); }
  // Return the path and the bytes of the scene in use; empty without a scene.
  [[nodiscard]] std::string_view path() const;
  [[nodiscard]] std::span<const std::byte> bytes() const { return bytes_of(places_[used_]); }
  // Return the scene that open_next has opened, and its bytes.
  [[nodiscard]] const rendering::SceneImage* next_scene() const {
    return scene_of(places_[1 - used_]);
  }
  [[nodiscard]] std::span<const std::byte> next_bytes() const {
    return bytes_of(places_[1 - used_]);
  }

  // Returns the index of the first object with that name in the scene in use, or nothing.
  [[nodiscard]] std::optional<std::uint32_t> find_object(std::string_view name) const;

 private:
  // A memory block with its scene. Its image, if there is one, points into the file's bytes.
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
  // The index of the scene in use; the other place is for the next one.
  std::size_t used_ = 0;
  std::size_t room_bytes_ = kMaxScene_bytes;
  // The text of a refused scene.
  std::array<char, 256> words_{};
};

}  // namespace tactus::firmware
