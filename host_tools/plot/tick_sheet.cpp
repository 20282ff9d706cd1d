#include "host_tools/plot/tick_sheet.h"

#include <fmt/format.h>

#include "host_tools/input_error.h"
#include "host_tools/plot/tick_script.h"

namespace tactus::host {

std::string tick_head(const PictureSize& sheet, double left, const std::string& title,
                      const std::string& facts) {
  constexpr double kTitleBelowTop = 32.0;
  constexpr double kFactsBelowTop = 66.0;
  return fmt::format(kTickHead, fmt::arg("title", gnuplot_string(title)),
                     fmt::arg("facts", gnuplot_string(facts)),
                     fmt::arg("left", left / sheet.width_px),
                     fmt::arg("title_y", 1.0 - kTitleBelowTop / sheet.height_px),
                     fmt::arg("facts_y", 1.0 - kFactsBelowTop / sheet.height_px));
}

PanelPlace foot_of(const PictureSize& sheet, double height) {
  constexpr double kMargin = 0.02;
  constexpr double kBottom = 0.005;
  return {.left = kMargin * sheet.width_px,
          .bottom = kBottom * sheet.height_px,
          .width = (1.0 - 2.0 * kMargin) * sheet.width_px,
          .height = height - kBottom * sheet.height_px};
}

std::string tick_key(const PictureSize& sheet, const PanelPlace& place, bool has_field) {
  std::string script = fmt::format(
      kTickKey, fmt::arg("left", place.left / sheet.width_px),
      fmt::arg("right", (place.left + place.width) / sheet.width_px),
      fmt::arg("bottom", place.bottom / sheet.height_px),
      fmt::arg("top", (place.bottom + place.height) / sheet.height_px),
      fmt::arg("direction", place.width > place.height ? "horizontal" : "vertical maxcols 1"));
  script += has_field ? kFieldEntries : kMeshEntries;
  return script + fmt::format(kStepEntries, fmt::arg("before", has_field ? "seed: proxy before"
                                                                         : "proxy before"));
}

std::string colour_bar(const PictureSize& sheet, const PanelPlace& panel, bool has_label) {
  constexpr double kAside = 14.0;
  constexpr double kWidth = 16.0;
  return fmt::format(
      "set colorbox user origin {:.5f},{:.5f} size {:.5f},{:.5f} noborder\n"
      "set cblabel {} textcolor \"#333333\" offset 0.6\nset cbtics textcolor \"#333333\"\n",
      (panel.left + panel.width + kAside) / sheet.width_px, panel.bottom / sheet.height_px,
      kWidth / sheet.width_px, panel.height / sheet.height_px,
      has_label ? "'F (the unit of the formula)'" : "''");
}

std::optional<TrackedFormula> tracked_formula(std::span<const TickSteps> ticks,
                                              std::span<const rendering::Object> objects) {
  const std::optional<std::size_t> number = formula_of(ticks);
  if (!number) {
    return std::nullopt;
  }
  if (*number >= objects.size() || objects[*number].surface != rendering::SurfaceKind::implicit) {
    throw InputError(fmt::format(
        "the ticks iterate on a formula of object {}, but the scene has none there; give the scene "
        "of the run",
        *number));
  }
  TrackedFormula formula{.surface = &objects[*number].implicit};
  for (const TickSteps& tick : ticks) {
    for (const StepMove& move : tick.moves) {
      formula.tolerance_m = move.formula ? move.formula->tolerance_m : formula.tolerance_m;
    }
  }
  return formula;
}

}  // namespace tactus::host
