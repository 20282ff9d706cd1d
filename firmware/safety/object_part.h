// The part of an object in the check of a scene against the certificate: how and where the tool
// feels the object. Not for a tick; a pure function of its arguments, for any thread.
#pragma once

#include "firmware/safety/scene_part.h"

namespace tactus::firmware {

// Returns the part of an object with that material.
ScenePart part_of_object(const rendering::Object& object, const rendering::Material& material,
                         const SceneFeel& feel);

}  // namespace tactus::firmware
