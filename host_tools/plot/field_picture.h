// The field of a formula as the background of a panel: bands of its values in colours that people
// who see few colours tell apart, its zero line, and the band in which a proxy is in contact.
#pragma once

#include <string>

#include "host_tools/plot/field_grid.h"
#include "host_tools/plot/gnuplot.h"

namespace tactus::host {

// The background as parts of a gnuplot script.
struct FieldPicture {
  // Data blocks, the colours and the range of the values. They come before the panel's `plot`.
  std::string head;
  // The picture and its lines, the first items of the `plot`; a comma ends them.
  std::string items;
};

// Samples the formula on the view's plane, writes its picture into the folder, and returns the
// parts; `name` tells several of them in one folder apart. A proxy less than `tolerance_m` above
// the surface is in contact; the band is drawn if it is wide enough to be seen. Where the formula
// has no values the picture is white. Throws InputError if the folder cannot be written.
FieldPicture draw_field(const rendering::ImplicitSurface& surface, const TickView& view,
                        const Window& window, double tolerance_m, std::size_t pixels,
                        const std::string& name, const GnuplotFolder& folder);

}  // namespace tactus::host
