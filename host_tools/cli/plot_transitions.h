// `tactus plot --transitions`: counts and draws the changes of state of a run.
#pragma once

#include <string>

#include "host_tools/plot/gnuplot.h"

namespace tactus::host {

// Prints the table of changes and draws it as <stem>_transitions in the folder `output`, with that
// prefix, or into that file if its name has the extension of a picture. `scene` may be empty.
// Throws InputError if the run cannot be read or the picture cannot be written.
void plot_transitions(const std::string& run, const std::string& scene, const std::string& output,
                      PictureFormat format);

}  // namespace tactus::host
