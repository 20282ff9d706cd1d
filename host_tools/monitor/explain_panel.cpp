#include "host_tools/monitor/explain_panel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "host_tools/monitor/explain_line.h"

namespace tactus::host {
namespace {

using firmware::Explanation;
using rendering::ContactKind;

// Returns a number in so many columns; a question mark for one that no tick can have.
std::string fixed(double value, int width, int digits) {
  return std::abs(value) < 1e3 ? fmt::format("{:>{}.{}f}", value, width, digits)
                               : fmt::format("{:>{}}", "?", width);
}

// Describes the feature, the friction and the moves.
std::string state_words(const Explanation& explanation) {
  const auto& [object, kind, face, edge, vertex] = explanation.feature;
  std::string words(contact_state(explanation));
  if (explanation.is_feature_known && kind == ContactKind::vertex) {
    words += fmt::format(" {}", vertex);
  }
  if (explanation.is_feature_known && kind == ContactKind::edge) {
    words += fmt::format(" {} of face", edge);
  }
  if (explanation.is_feature_known && kind != ContactKind::vertex) {
    words += fmt::format(" {}", face);
  }
  if (kind != ContactKind::none) {
    words += fmt::format(", object {}, {}", object, friction_word(explanation));
  }
  const bool is_formula = explanation.moves == 0 && explanation.iterations > 0;
  return words + (is_formula ? fmt::format("; {} iterations", explanation.iterations)
                             : fmt::format("; {} moves", explanation.moves));
}

std::string plane_row(const firmware::ActivePlane& plane) {
  const auto& [feature, normal, tool_distance_m, multiplier_m] = plane;
  return fmt::format("{:>4}{:>8}{}{}{}{}{}", feature.object, feature.face, fixed(normal[0], 6, 2),
                     fixed(normal[1], 6, 2), fixed(normal[2], 6, 2),
                     fixed(1e3 * tool_distance_m, 8, 3), fixed(1e3 * multiplier_m, 8, 3));
}

void draw_circle(Canvas& canvas, std::size_t row, const Explanation& explanation) {
  const auto& [static_m, dynamic_m, lag_m] = explanation.circle;
  if (explanation.has_circle) {
    canvas.put(row, 0,
               fmt::format("circle mm{} stick{} slip{} lag", fixed(1e3 * static_m, 7, 3),
                           fixed(1e3 * dynamic_m, 7, 3), fixed(1e3 * lag_m, 7, 3)));
  }
}

}  // namespace

void draw_explanation(Canvas& canvas, std::size_t row, std::size_t right,
                      const Explanation& explanation) {
  canvas.put(row, 0, state_words(explanation), Style::strong);
  const firmware::Triple& surface = explanation.surface_W;
  canvas.put(row + 1, 0,
             fmt::format("surface mm {} {} {}", fixed(1e3 * surface[0], 9, 3),
                         fixed(1e3 * surface[1], 9, 3), fixed(1e3 * surface[2], 9, 3)));
  canvas.put(row + 2, 0, " obj    face   n_x   n_y   n_z tool mm push mm", Style::faint);
  const std::size_t planes =
      std::min<std::size_t>(explanation.plane_count, firmware::kMaxActivePlanes);
  for (std::size_t i = 0; i < planes; ++i) {
    canvas.put(row + 3 + i, 0, plane_row(explanation.planes[i]));
  }
  draw_circle(canvas, row + 6, explanation);
  for (std::size_t step = 0; step < explanation.step_ns.size(); ++step) {
    canvas.put(row + step, right,
               fmt::format("{} {:<10}{:>8.1f}", step + 1, firmware::kTickStepNames[step],
                           1e-3 * explanation.step_ns[step]));
  }
}

}  // namespace tactus::host
