// Reads the needle and the tissues from an image and checks them. For the .cpp files of this folder
// only.
#pragma once

#include <expected>

#include "rendering/needle/tissue.h"
#include "rendering/objects/object.h"
#include "rendering/scene/scene_error.h"
#include "rendering/scene/scene_generated.h"

namespace tactus::rendering {

// Returns the needle; none for nullptr. Errors: needle.
std::expected<Needle, SceneError> read_needle(const image::Needle* stored);

// Returns the tissue of an object whose surface, motion and body are read. Errors: tissue.
std::expected<Tissue, SceneError> read_tissue(const image::Tissue& stored, const Needle& needle,
                                              const Object& object);

}  // namespace tactus::rendering
