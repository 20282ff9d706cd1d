// The motion that the simulated hand of a bare board wants: over the top of the scene's ball, in a
// curve that does not repeat for hours, leaving the surface now and then. Closed form; any thread.
#pragma once

#include <cstdint>

#include "rendering/geometry/vector.h"

namespace tactus::firmware {

// Returns the wished position of the tool at a tick of 1 kHz, m, world frame. The ball of
// firmware/mps2_an500/scene.toml is about the origin.
Vec3 stroke_W(std::uint64_t tick);

}  // namespace tactus::firmware
