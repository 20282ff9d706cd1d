#include "host_tools/plot/figures.h"

namespace tactus::host {

namespace {

// Returns the beginning of the files' names for the user's -o.
std::string prefix_of(const std::filesystem::path& output, const std::string& stem) {
  const bool folder = std::filesystem::is_directory(output) || !output.has_filename();
  return folder ? (output / stem).string() : output.string();
}

}  // namespace

FigureFiles figure_files(const std::filesystem::path& output, const std::string& stem) {
  const std::string prefix = prefix_of(output, stem);
  return {.force = prefix + "_force.png",
          .path = prefix + "_path.png",
          .against = prefix + "_against.png"};
}

std::filesystem::path tick_figure_file(const std::filesystem::path& output, const std::string& stem,
                                       std::size_t tick) {
  return prefix_of(output, stem) + "_tick" + std::to_string(tick) + ".png";
}

}  // namespace tactus::host
