// Writes effects, poses and primitives in the form of the image's schema
// (rendering/scene/scene.fbs). Only image_writer.cpp calls it.
#pragma once

#include <vector>

#include "rendering/effects/effect.h"
#include "rendering/scene/scene_generated.h"

namespace tactus::host {

// Return the value in the schema's type.
rendering::image::Double3 stored(const Vec3& v);
rendering::image::Pose stored(const rendering::RigidPose& pose);

// Writes a primitive and returns its place in the builder.
flatbuffers::Offset<rendering::image::Primitive> write_primitive(
    flatbuffers::FlatBufferBuilder& builder, const rendering::Primitive& primitive);

// Writes all effects; returns a null offset if there are none, so that the image has no empty list.
flatbuffers::Offset<flatbuffers::Vector<flatbuffers::Offset<rendering::image::Effect>>>
write_effects(flatbuffers::FlatBufferBuilder& builder,
              const std::vector<rendering::Effect>& effects);

}  // namespace tactus::host
