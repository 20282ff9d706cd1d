// Draws the runs of a comparison over each other.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "host_tools/compare/compared_run.h"
#include "host_tools/compare/run_figures.h"
#include "rendering/objects/object.h"

namespace tactus::host {

// Draws the part of the runs within the span of time: at the left the tool's path and the proxies'
// in the plane of the world in which the path is longest, with the objects cut where the tool is;
// at the right the forces, and the distance of the proxies from that of the first run. The ending
// of the file's name decides the format. Throws InputError if gnuplot is missing or fails.
void draw_comparison(std::span<const ComparedRun> runs, const TimeSpan& span,
                     std::span<const rendering::Object> objects, const std::string& title,
                     const std::filesystem::path& picture);

}  // namespace tactus::host
