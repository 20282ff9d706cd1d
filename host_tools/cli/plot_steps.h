// The options of `tactus plot --explain`: pictures of ticks out of a file of steps.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "host_tools/plot/gnuplot.h"
#include "host_tools/plot/tick_steps.h"

namespace CLI {
class App;
}  // namespace CLI

namespace tactus::host {

// The options as the user gave them.
struct StepsPlotOptions {
  bool is_wanted = false;
  TickChoice tick;
  std::optional<TickRange> range;
  // The folder of the frames, or the number of pictures in a strip of bodies (plot_bodies.h), and
  // the file of the animation; empty for none.
  std::string frames;
  std::string animation;
  std::optional<double> frames_per_s;
};

// The files that the pictures are made of, and the place where they go.
struct StepsPlotFiles {
  std::string steps;
  std::string scene;
  // A folder, a prefix or a picture's file; empty for this folder.
  std::string output;
  PictureFormat format = PictureFormat::png;
};

// Adds --explain and what belongs to it.
void add_steps_options(CLI::App& verb, const std::shared_ptr<StepsPlotOptions>& options);

// Draws one tick, a strip, frames or an animation, and prints the names of the files. Throws
// InputError.
void draw_steps(const StepsPlotOptions& options, const StepsPlotFiles& files);

}  // namespace tactus::host
