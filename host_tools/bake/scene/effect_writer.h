// Effects and what they share with objects, as the image's schema stores them. For
// image_writer.cpp.
#pragma once

#include <vector>

#include "rendering/effects/effect.h"
#include "rendering/scene/scene_generated.h"

namespace tactus::host {

rendering::image::Double3 stored(const Vec3& v);
rendering::image::Pose stored(const rendering::RigidPose& pose);

flatbuffers::Offset<rendering::image::Primitive> write_primitive(
    flatbuffers::FlatBufferBuilder& builder, const rendering::Primitive& primitive);

// Null where there is none.
flatbuffers::Offset<flatbuffers::Vector<flatbuffers::Offset<rendering::image::Effect>>>
write_effects(flatbuffers::FlatBufferBuilder& builder,
              const std::vector<rendering::Effect>& effects);

}  // namespace tactus::host
