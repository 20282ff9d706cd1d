// `tactus plot --frames N`: the strip of the moving world.
#pragma once

#include <string>

#include "host_tools/plot/gnuplot.h"

namespace tactus::host {

// The files and the number of pictures, as the user gave them.
struct BodiesPlotOptions {
  // The run of the first tool, or a file of --bodies itself; the runs of other tools, run.2.csv and
  // so on, are found beside it.
  std::string run;
  // The file of --bodies; empty if `run` is one.
  std::string bodies;
  std::string scene;
  // A folder, a prefix or a picture's file; empty for this folder.
  std::string output;
  PictureFormat format = PictureFormat::png;
  // A number in the user's digits.
  std::string frames;
};

// Draws the strip and prints the picture's name. Throws InputError.
void plot_bodies(const BodiesPlotOptions& options);

}  // namespace tactus::host
