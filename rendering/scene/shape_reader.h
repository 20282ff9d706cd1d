// Reads a surface without a mesh: a primitive or a formula. SceneImage and effect_reader.cpp use
// it.
#pragma once

#include <expected>
#include <optional>

#include "rendering/objects/object.h"
#include "rendering/scene/scene_error.h"

namespace tactus::rendering {

namespace image {
struct Object;
struct Primitive;
}  // namespace image

// Returns the primitive, or nothing if it is not valid.
std::optional<Primitive> read_primitive(const image::Primitive& stored);

// Takes the shape of an object whose sides are read; an object without one keeps its mesh as the
// touched surface. The error's object is left at kNoObject.
std::expected<void, SceneError> take_shape(const image::Object& stored, Object& object);

}  // namespace tactus::rendering
