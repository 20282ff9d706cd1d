// The JSON Schemas of the server's messages. Those of Foxglove have the names and the fields by
// which its panels know them; those of ours are made from the columns of a recording. Pure
// functions for any thread.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace tactus::host {

// The names of Foxglove's own schemas.
inline constexpr const char* kSceneUpdateSchema = "foxglove.SceneUpdate";
inline constexpr const char* kPoseInFrameSchema = "foxglove.PoseInFrame";
inline constexpr const char* kFrameTransformsSchema = "foxglove.FrameTransforms";

// Return Foxglove's schemas. That of a SceneUpdate has the kinds of primitives that this server
// sends: arrows, spheres and triangles; the others are lists that stay empty.
std::string scene_update_schema();
std::string pose_in_frame_schema();
std::string frame_transforms_schema();

// A field of one of our messages: a number, or a word.
struct NamedField {
  std::string name;
  bool is_number = true;
};

// Returns the schema of an object with these fields. None of them is required: a number that is not
// finite is left out of its message, because JSON has none.
std::string fields_schema(const std::string& title, std::span<const NamedField> fields);

}  // namespace tactus::host
