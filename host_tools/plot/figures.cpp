#include "host_tools/plot/figures.h"

namespace tactus::host {

FigureFiles figure_files(const std::filesystem::path& output, const std::string& stem) {
  const bool folder = std::filesystem::is_directory(output) || !output.has_filename();
  const std::string prefix = folder ? (output / stem).string() : output.string();
  return {.force = prefix + "_force.png",
          .path = prefix + "_path.png",
          .against = prefix + "_against.png"};
}

}  // namespace tactus::host
