// The figures of a run, as PNG files.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "host_tools/plot/run_data.h"
#include "rendering/objects/object.h"

namespace tactus::host {

struct FigureFiles {
  std::filesystem::path force;    // force and depth over time
  std::filesystem::path path;     // the proxy's path over the scene, from two sides
  std::filesystem::path against;  // two runs over one another
};

// Names from the user's -o: an existing folder, or a name ending in a slash, gives
// FOLDER/<stem>_force.png, ..._path.png and ..._against.png; anything else is a prefix:
// <prefix>_force.png and so on.
FigureFiles figure_files(const std::filesystem::path& output, const std::string& stem);

// Force and depth in stacked panels over a shared time axis, the background telling stick from
// slip. Throws InputError when gnuplot is missing or fails.
void draw_force_figure(const RunData& run, const std::string& title,
                       const std::filesystem::path& png);

// The path of the proxy's centre, coloured by force where it touched, from the front and from the
// side, both panels with equal axes. Throws InputError when gnuplot is missing or fails.
void draw_path_figure(const RunData& run, std::span<const rendering::Object> objects,
                      const std::string& title, const std::filesystem::path& png);

struct NamedRun {
  const RunData& run;
  std::string name;
};

// The forces of two runs in one panel, and by how much each turns from tick to tick in another.
// Throws InputError when gnuplot is missing or fails.
void draw_against_figure(const NamedRun& run, const NamedRun& other,
                         const std::filesystem::path& png);

}  // namespace tactus::host
