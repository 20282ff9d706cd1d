// `tactus plot --transitions`: counts and draws the changes of state of a run.
#pragma once

#include <string>

namespace tactus::host {

// Prints the table of changes and draws it as <stem>_transitions.png in the folder `output`, with
// that prefix, or into that file if its name ends in .png or .svg. `scene` may be empty. Throws
// InputError if the run cannot be read or the picture cannot be written.
void plot_transitions(const std::string& run, const std::string& scene, const std::string& output);

}  // namespace tactus::host
