#include "host_tools/cli/plot_run.h"

#include <fmt/format.h>

namespace tactus::host {

void plot_run(const NamedRun& named, std::span<const rendering::Object> objects,
              const FigureFiles& files) {
  draw_force_figure(named.run, fmt::format("{}: force and depth", named.name), files.force);
  draw_path_figure(named.run, objects, fmt::format("{}: path of the proxy", named.name),
                   files.path);
  fmt::print("{}\n{}\n", files.force.string(), files.path.string());
}

}  // namespace tactus::host
