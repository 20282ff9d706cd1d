// The reasons for which a scene image is refused, and the place of the fault. SceneImage::open
// returns them; tactus inspect and the controller show describe() to the user.
#pragma once

#include <array>
#include <cstdint>
#include <expected>
#include <span>
#include <string_view>

#include "rendering/objects/object.h"
#include "rendering/profiles/scene_capacity.h"

namespace tactus::rendering {

// The faults. scene_error.cpp lists their texts in the same order.
enum class SceneFault : std::uint8_t {
  misaligned,         // the first byte is not at a multiple of kImageAlignment
  truncated,          // place: number of bytes there are
  wrong_magic,        // place: first byte that differs
  older_version,      // place: version found
  newer_version,      // place: version found
  too_large,          // place: payload bytes that the header states
  trailing_bytes,     // place: byte where the image should end
  checksum_mismatch,  // a bit has changed somewhere
  malformed,          // the FlatBuffers verifier refused the payload
  object_count,       // none
  tool_radius,        // negative, above kMaxToolRadius_m or not a number
  sides,              // neither one nor two; place: value found
  friction_model,     // not one that this controller knows; place: number found
  material,           // a coefficient negative, not finite, or dynamic above static
  empty_mesh,         // no vertex, triangle or node
  array_sizes,        // normals differ in number from vertices, or neighbours from triangles
  vertex_not_finite,  // place: vertex
  normal_not_finite,  // place: vertex
  vertex_index,       // place: triangle
  neighbour_index,    // out of range or not mutual; place: triangle
  hierarchy_child,    // a child that is missing or not after its parent; place: node
  hierarchy_depth,    // more than kMaxHierarchyDepth levels; place: node
  hierarchy_cover,    // leaves that do not list every triangle once, in order; place: node
  hierarchy_box,      // a box that does not hold what is below it; place: node
  shape,              // a primitive or implicit surface with a number out of range
  formula,            // instructions that must not be carried out; place: instruction
  method,             // unknown, or one that does not go with the surface; place: value found
  tool_count,         // none
  corner_normals,     // not one a triangle; place: number found
  corner_places,      // not one a triangle, or not finite or out of range; place: triangle
  texture,            // sizes, bytes or numbers out of range, or a second of its kind; place: layer
  effect,             // unknown law, or a number out of range; place: effect
  motion,             // a number out of range, or of an object that does not move
  capacity,           // one of the profile is exceeded: see SceneError::exceeded
  effect_law,         // a law that this controller does not have; place: effect
  body,               // a mass, hull or number out of range, or an object that cannot be one
  needle,             // a number of the needle out of range
  tissue,             // a number out of range, or of an object that cannot be pierced
  body_part,          // neither a convex primitive nor a sound hull; place: part
};

// A name from an image, for a message: the first 31 characters, with ? for those that are not
// printable ASCII.
class FaultName {
 public:
  FaultName() = default;
  explicit FaultName(std::string_view text);

  [[nodiscard]] std::string_view text() const { return {text_.data(), size_}; }

 private:
  std::array<char, 31> text_{};
  std::uint8_t size_ = 0;
};

// A fault, the object at fault and the place in it.
struct SceneError {
  SceneFault fault = SceneFault::malformed;
  // The index of the object at fault; kNoObject if the fault is not of one object.
  std::uint32_t object = kNoObject;
  // The place; what it counts stands beside each fault, and in place_noun.
  std::uint64_t place = 0;
  // The name of an unknown effect law; empty for every other fault.
  FaultName name;
  // The capacity that the scene exceeds; set if the fault is `capacity`.
  ExceededCapacity exceeded;
};

// Returns the error of that fault at that place, as the result of a function that found it.
inline std::unexpected<SceneError> fail(SceneFault fault, std::uint64_t place = 0) {
  return std::unexpected(SceneError{.fault = fault, .place = place});
}
// Returns the error of a scene that exceeds a capacity.
inline std::unexpected<SceneError> fail(const ExceededCapacity& exceeded) {
  return std::unexpected(SceneError{.fault = SceneFault::capacity, .exceeded = exceeded});
}

// Returns the fault and its remedy as text, without the place.
std::string_view describe(SceneFault fault);
// Returns the same, for a capacity with its name and both numbers. That text is written into `room`
// and cut at its end; 256 bytes are enough.
std::string_view describe(const SceneError& error, std::span<char> room);

// Returns the noun that SceneError::place counts, such as "byte" or "vertex"; empty if the fault
// has no place.
std::string_view place_noun(SceneFault fault);

}  // namespace tactus::rendering
