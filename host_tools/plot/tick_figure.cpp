#include "host_tools/plot/tick_figure.h"

#include <algorithm>
#include <ranges>

#include "host_tools/plot/tick_sheet.h"

namespace tactus::host {
namespace {

// The sheet, in pixels: two square panels side by side, a title above and a key below.
constexpr double kTickSheetWidth = 1800.0;
constexpr double kTickPanel = 760.0;
constexpr double kTickLeft = 100.0;
constexpr double kTickGap = 110.0;
constexpr double kTickBottom = 210.0;
constexpr double kTickTop = 110.0;
constexpr double kTickKeyHeight = kTickBottom - 85.0;
constexpr double kTickSheetHeight = kTickBottom + kTickPanel + kTickTop;
// The room for a colour bar right of a panel.
constexpr double kTickBar = 130.0;

// The room between a colour bar and the axis of the next panel.
constexpr double kTickBarGap = 20.0;

constexpr std::string_view kAlongPull = "along the pull on the surface (mm)";
constexpr std::string_view kAlongNormal = "along the contact normal (mm)";

// Returns the window about the last moves of a tick in the view: as many as are close together.
Window window_of_last_moves(const TickSteps& tick, const TickView& view, const Window& whole,
                            double tolerance_m) {
  constexpr double kLargest = 0.05;
  constexpr double kHalf = 0.7;
  constexpr double kLeastTolerances = 10.0;
  Window window;
  window.include(view.point(tick.proxy_W));
  for (const StepMove& move : std::views::reverse(tick.moves)) {
    Window grown = window;
    grown.include(view.point(move.to_W));
    grown.include(view.point(move.from_W));
    if (std::max(grown.width(), grown.height()) > kLargest * whole.width()) {
      break;
    }
    window = grown;
  }
  return square_about(window, kHalf, 1e3 * kLeastTolerances * tolerance_m);
}

// Draws the tick twice across the surface over the field.
void draw_field_figure(const TickSteps& tick, std::span<const rendering::Object> objects,
                       const TrackedFormula& formula, const std::string& title,
                       const std::filesystem::path& picture) {
  constexpr double kContext = 1.25;
  const PictureSize sheet{.width_px = kTickSheetWidth + 2.0 * kTickBar + kTickBarGap,
                          .height_px = kTickSheetHeight};
  const GnuplotFolder folder;
  const TickView view({&tick, 1}, false);
  const Window tight = view.window({&tick, 1});
  const Window whole = square_about(tight, 0.5 * kContext, 0.0);
  std::string script = tick_head(sheet, kTickLeft, title, facts_of(tick));
  for (const bool is_close : {false, true}) {
    const std::string name = is_close ? "close" : "whole";
    const Window window =
        is_close ? window_of_last_moves(tick, view, whole, formula.tolerance_m) : whole;
    const FieldPicture field = draw_field(*formula.surface, view, window, formula.tolerance_m,
                                          static_cast<std::size_t>(kTickPanel), name, folder);
    const TickPanel panel{
        .tick = tick,
        .view = view,
        .window = window,
        .place = {.left =
                      kTickLeft + (is_close ? kTickPanel + kTickGap + kTickBar + kTickBarGap : 0.0),
                  .bottom = kTickBottom,
                  .width = kTickPanel,
                  .height = kTickPanel},
        .suffix = name,
        .title = {},
        .x_label = is_close ? "along the pull, close to the last iterations (mm)"
                            : std::string(kAlongPull),
        .y_label = std::string(kAlongNormal),
        .field = &field,
        .has_numbers = is_close};
    script += colour_bar(sheet, panel.place, is_close) + tick_panel(panel, objects, sheet);
  }
  script += tick_key(sheet, foot_of(sheet, kTickKeyHeight), true);
  run_gnuplot(folder, sheet, script, picture);
}

}  // namespace

void draw_tick_figure(const TickSteps& tick, std::span<const rendering::Object> objects,
                      const std::string& title, const std::filesystem::path& picture) {
  if (const auto formula = tracked_formula({&tick, 1}, objects)) {
    draw_field_figure(tick, objects, *formula, title, picture);
    return;
  }
  const PictureSize sheet{.width_px = kTickSheetWidth, .height_px = kTickSheetHeight};
  const GnuplotFolder folder;
  std::string script = tick_head(sheet, kTickLeft, title, facts_of(tick));
  for (const bool from_above : {false, true}) {
    const TickView view({&tick, 1}, from_above);
    const TickPanel panel{
        .tick = tick,
        .view = view,
        .from_above = from_above,
        .window = view.window({&tick, 1}),
        .place = {.left = kTickLeft + (from_above ? kTickPanel + kTickGap : 0.0),
                  .bottom = kTickBottom,
                  .width = kTickPanel,
                  .height = kTickPanel},
        .suffix = from_above ? "above" : "across",
        .title = {},
        .x_label = std::string(kAlongPull),
        .y_label = std::string(from_above ? "across it, seen from above (mm)" : kAlongNormal)};
    script += tick_panel(panel, objects, sheet);
  }
  script += tick_key(sheet, foot_of(sheet, kTickKeyHeight), false);
  run_gnuplot(folder, sheet, script, picture);
}

}  // namespace tactus::host
