#include "host_tools/cli/bake_report.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <string>

#include "host_tools/cli/progress_line.h"

namespace tactus::host {

BakeReport bake_with_progress(const std::filesystem::path& scene,
                              const std::filesystem::path& image) {
  if (::isatty(STDERR_FILENO) != 1) {
    return bake_file(scene, image);
  }
  ProgressLine line;
  return bake_file(scene, image, [&](std::string_view step) { line.step(step); });
}

void print_bake_warnings(std::string_view verb, const BakeReport& report) {
  for (const ObjectReport& object : report.objects) {
    for (const std::string& warning : object.warnings) {
      fmt::print(stderr, "tactus {}: warning: {}\n", verb, warning);
    }
  }
}

void print_bake_table(const BakeReport& report) {
  fmt::print("{:<16} {:>10} {:>10} {:>8} {:>8} {:>10} {:>12} {:>7}\n", "object", "triangles",
             "vertices", "dropped", "welded", "open edges", "bytes", "s");
  for (const ObjectReport& o : report.objects) {
    fmt::print("{:<16} {:>10} {:>10} {:>8} {:>8} {:>10} {:>12} {:>7.2f}\n", o.name, o.triangles,
               o.vertices, o.counters.degenerate_triangles, o.counters.welded_vertices,
               o.counters.open_edges, o.bytes, o.seconds);
  }
  fmt::print("{}: {} bytes, tool radius {} m, baked in {:.2f} s\n", report.image, report.bytes,
             report.tool_radius_m, report.seconds);
}

}  // namespace tactus::host
