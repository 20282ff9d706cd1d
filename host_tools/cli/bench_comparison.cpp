#include "host_tools/cli/bench_comparison.h"

#include <fmt/format.h>

#include <cstdio>
#include <nlohmann/json.hpp>

namespace tactus::host {
namespace {

void print_text(const ComparedRow& row) {
  const auto& [here, there] = row;
  fmt::print(
      "{:<7} {:>7.0f} {:g} mm {:<6} median {:>6.0f} ns, there {:>6.0f}, ratio {:.3f}; p99 {:.3f}; "
      "p99.9 "
      "{:.3f}",
      here.mesh, here.triangles, here.radius_mm, here.motion, here.median_ns, there.median_ns,
      here.median_ns / there.median_ns, here.p99_ns / there.p99_ns, here.p999_ns / there.p999_ns);
  if (here.instructions && there.instructions) {
    fmt::print("; instructions {:.0f}, there {:.0f}, ratio {:.4f}", *here.instructions,
               *there.instructions, *here.instructions / *there.instructions);
  }
  if (here.late_ticks && there.late_ticks) {
    fmt::print("; late {:.0f}, there {:.0f}", *here.late_ticks, *there.late_ticks);
  }
  fmt::print("\n");
}

nlohmann::ordered_json json_of(const FigureRow& row) {
  nlohmann::ordered_json json{
      {"median_ns", row.median_ns}, {"p99_ns", row.p99_ns}, {"p999_ns", row.p999_ns}};
  if (row.instructions) {
    json["instructions_median"] = *row.instructions;
  }
  if (row.late_ticks) {
    json["late_ticks"] = *row.late_ticks;
  }
  return json;
}

void print_json(const ComparedRow& row) {
  fmt::print("{}\n", nlohmann::ordered_json{{"bench", "touch"},
                                            {"mesh", row.here.mesh},
                                            {"triangles", row.here.triangles},
                                            {"radius_mm", row.here.radius_mm},
                                            {"motion", row.here.motion},
                                            {"here", json_of(row.here)},
                                            {"there", json_of(row.there)}}
                         .dump());
}

}  // namespace

void bench_comparison(Comparison comparison, bool json) {
  const std::size_t turns = comparison.turns;
  comparison.progress = [turns](std::size_t turn, bool here) {
    fmt::print(stderr, "turn {} of {}: {}\n", turn, turns, here ? "this program" : "the other");
  };
  for (const ComparedRow& row : compare(comparison)) {
    json ? print_json(row) : print_text(row);
  }
}

}  // namespace tactus::host
