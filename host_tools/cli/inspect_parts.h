// Shows the convex parts of a body. The verb inspect uses it.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "rendering/scene/scene_image.h"

namespace tactus::host {

// Returns the parts of the body of an object; none for one that has none.
std::vector<rendering::BodyPart> parts_of(const rendering::SceneImage& image, std::size_t object);

// Returns the kind of each part and its box in the frame of the scene, m.
nlohmann::ordered_json json_of_parts(const std::vector<rendering::BodyPart>& parts);

// Prints them, one a line.
void print_parts(const std::vector<rendering::BodyPart>& parts);

}  // namespace tactus::host
