// Draws one tick as the lecture's slides do: the moves of the proxy, the planes that bound them,
// and the friction cone.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "host_tools/plot/tick_steps.h"
#include "rendering/objects/object.h"

namespace tactus::host {

// Draws the tick in two views: across the surface, in the plane of the contact normal and of the
// tool's pull along the surface, with the objects cut open; and from above, along the normal, with
// the friction circles. Objects that move are drawn where the scene gives them. Throws InputError
// if gnuplot is missing or fails.
void draw_tick_figure(const TickSteps& tick, std::span<const rendering::Object> objects,
                      const std::string& title, const std::filesystem::path& picture);

}  // namespace tactus::host
