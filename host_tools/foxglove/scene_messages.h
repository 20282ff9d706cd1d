// The messages that show a scene: its objects as triangles, and the frames in which they are. Pure
// functions for any thread.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "firmware/telemetry/object_places.h"
#include "rendering/scene/scene_image.h"

namespace tactus::host {

// Returns the frame of an object: the world, or its own frame if it moves.
std::string object_frame(const rendering::SceneImage& scene, std::size_t object);

// Returns a SceneUpdate with every object of the scene in place of all that were there before. The
// triangles are those of the image: of meshes, and the pictures of primitives and formulas that
// baking made.
std::string scene_message(const rendering::SceneImage& scene, std::uint64_t time_ns);
// Returns a SceneUpdate that removes every object.
std::string empty_scene_message(std::uint64_t time_ns);

// The places of the objects that move, and their time.
struct TimedPlaces {
  std::uint64_t time_ns = 0;
  std::span<const firmware::ObjectPlace> places;
};

// Returns FrameTransforms from the upright frame to the world at `time_ns`, and from there to each
// object that moves, at the time of the places. An object without a place is where the scene puts
// it.
std::string frames_message(const rendering::SceneImage* scene, const TimedPlaces& timed,
                           std::uint64_t time_ns);

}  // namespace tactus::host
