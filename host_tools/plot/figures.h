// The figures of a run, and of the holes in a scene, as PNG, SVG or PDF files. `tactus plot`,
// `tactus replay
// --picture` and `tactus inspect --picture` draw them.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "host_tools/plot/gnuplot.h"
#include "host_tools/plot/run_data.h"
#include "rendering/objects/object.h"

namespace tactus::host {

// The files of the figures.
struct FigureFiles {
  // Force and depth over time.
  std::filesystem::path force;
  // The proxy's path over the scene, from two sides.
  std::filesystem::path path;
  // Two runs over each other.
  std::filesystem::path against;
};

// Returns the files for the user's -o. An existing folder, or a name that ends in a slash, gives
// FOLDER/<stem>_force.png, ..._path.png and ..._against.png in the given format. `ears.svg` gives
// ears_force.svg and so on; a name without an extension is a prefix, in the given format. Throws
// InputError for another extension than picture_format() knows.
FigureFiles figure_files(const std::filesystem::path& output, const std::string& stem,
                         PictureFormat format = PictureFormat::png);

// Returns the file of a lone figure in the same manner, <stem><name>.png in a folder; but a name
// with an extension is the file itself.
std::filesystem::path figure_file(const std::filesystem::path& output, const std::string& stem,
                                  const std::string& name,
                                  PictureFormat format = PictureFormat::png);

// Draws force and depth in two panels over one time axis; the background shows stick and slip.
// Throws InputError if gnuplot is missing or fails.
void draw_force_figure(const RunData& run, const std::string& title,
                       const std::filesystem::path& picture);

// Draws the path of the proxy's centre over the scene, from the front and from the side, with equal
// axes; where it touches, it is coloured by force. Throws InputError if gnuplot is missing or
// fails.
void draw_path_figure(const RunData& run, std::span<const rendering::Object> objects,
                      const std::string& title, const std::filesystem::path& picture);

// A run and its name in the key.
struct NamedRun {
  // Must outlive this.
  const RunData& run;
  std::string name;
};

// Draws the forces of two runs in one panel, and the angle by which each turns from tick to tick in
// another. Throws InputError if gnuplot is missing or fails.
void draw_against_figure(const NamedRun& run, const NamedRun& other,
                         const std::filesystem::path& picture);

// A hole of a mesh, to be marked.
struct HoleMark {
  // The vertices of its rim in their order, world frame, m.
  std::vector<Vec3> rim_W;
  // The middle and the diameter of a ball that holds it.
  Vec3 middle_W = Vec3::Zero();
  double size_m = 0.0;
};

// Draws the objects from the front and from the side, with the rim of each hole in red, also where
// the mesh hides it, a ring about it and its number in the list, from 1. Throws InputError if
// gnuplot is missing or fails.
void draw_holes_figure(std::span<const rendering::Object> objects, std::span<const HoleMark> holes,
                       const std::string& title, const std::filesystem::path& picture);

}  // namespace tactus::host
