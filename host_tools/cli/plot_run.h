// The two figures of a run, as `tactus plot` and `tactus demo` draw them.
#pragma once

#include <span>

#include "host_tools/plot/figures.h"
#include "rendering/objects/object.h"

namespace tactus::host {

// Draws force and depth over time, and the path over the objects, and prints the names of both
// pictures on stdout. The run's name is in the titles. Throws InputError.
void plot_run(const NamedRun& named, std::span<const rendering::Object> objects,
              const FigureFiles& files);

}  // namespace tactus::host
