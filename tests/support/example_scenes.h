// The scenes under host_tools/examples that need no foreign file: a new one goes here, and is
// baked, touched and restored by the tests.
#pragma once

#include <array>

namespace tactus::testing {

inline constexpr std::array kExampleScenes{
    "ramp",    "primitives", "heart",       "thin_plate",
    "grating", "stone",      "tiles",       "shaded_cylinder",
    "effects", "paddle",     "membrane",    "friction",
    "wall",    "gem",        "shapes",      "notch",
    "grasp",   "stack",      "turned_ball", "epidural",
    "cup"};

}  // namespace tactus::testing
