// Reads the body of an object from an image and checks it. For the .cpp files of this folder only.
#pragma once

#include <expected>

#include "rendering/objects/object.h"
#include "rendering/objects/object_body.h"
#include "rendering/scene/scene_error.h"
#include "rendering/scene/scene_generated.h"

namespace tactus::rendering {

// Returns the gravity, m/s^2: the earth's where there is none, or none that is finite and at most
// kMostGravity_m_per_s2.
Vec3 read_gravity(const image::Double3* stored);

// Returns the modulus of soft fingers, Pa: 0 where it is none that fingers may have.
double read_finger_modulus(double stored);

// Returns the rest after which bodies fall asleep, s: 0 where it is none that they may have.
double read_sleep_time(double stored);

// Returns the body of an object whose surface, method and motion are read; its hull is used in
// place. Its parts are not read, but counted. Errors: body, malformed.
std::expected<ObjectBody, SceneError> read_body(const image::Body& stored, const Object& object);

// Returns a part of a body; its hull is used in place. Errors: body_part, malformed.
std::expected<BodyPart, SceneError> read_body_part(const image::BodyPart& stored);

}  // namespace tactus::rendering
