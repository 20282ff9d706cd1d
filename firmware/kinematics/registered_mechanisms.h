// The mechanisms, each in a file of its own: a new mechanism is one more #include and one more name
// here.
//
// A mechanism is a class with
//   Geometry        its dimensions and weights, a plain struct
//   kJoints         1 to 3
//   kSlides         true if its joints slide; all others turn
//   keys            the keys of [mechanism] in TOML
//   forward         the pose of the tool
//   gravity_effort  the efforts that hold its weights
// and, for its geometry, check_geometry, has_weight, and a transfer of every member
// (rendering/state_archive.h).
#pragma once

#include "firmware/kinematics/cartesian.h"
#include "firmware/kinematics/delta.h"
#include "firmware/kinematics/paddle.h"
#include "firmware/kinematics/pantograph.h"
#include "firmware/kinematics/serial_arm.h"
#include "rendering/type_list.h"

namespace tactus::firmware {

// A mechanism's place is its number in recordings: add new ones at the end.
using Mechanisms = TypeList<Cartesian, Delta, Paddle, Pantograph, SerialArm>;

}  // namespace tactus::firmware
