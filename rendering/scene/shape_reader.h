// Reads a surface without a mesh: a primitive or a formula.
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

// The shape of an object whose sides are read; without one, its mesh stays what is touched. The
// error's object is left at kNoObject.
std::expected<void, SceneError> take_shape(const image::Object& stored, Object& object);

}  // namespace tactus::rendering
