#include <fmt/format.h>

#include <utility>

#include "host_tools/plot/tick_figure.h"
#include "host_tools/plot/tick_sheet.h"

namespace tactus::host {
namespace {

// The strip, in pixels: square panels in a row, a title above and a key below.
constexpr double kStripPanel = 400.0;
constexpr double kStripLeft = 100.0;
constexpr double kStripGap = 40.0;
constexpr double kStripBottom = 200.0;
constexpr double kStripTop = 115.0;
constexpr double kStripKeyHeight = 120.0;
constexpr double kStripRight = 40.0;
// An axis has at most so many steps between its marks.
constexpr double kStripTics = 5.0;
// The key needs so much.
constexpr double kStripLeastWidth = 1500.0;

// A frame, in pixels: one square panel with room for a colour bar and the key at its right.
constexpr double kFramePanel = 640.0;
constexpr double kFrameLeft = 100.0;
constexpr double kFrameBottom = 90.0;
constexpr double kFrameTop = 90.0;
constexpr double kFrameBar = 165.0;
constexpr double kFrameKeyWidth = 345.0;
constexpr PictureSize kFrameSheet{.width_px = kFrameLeft + kFramePanel + kFrameBar + kFrameKeyWidth,
                                  .height_px = kFrameBottom + kFramePanel + kFrameTop};
constexpr PanelPlace kFrameKey{.left = kFrameLeft + kFramePanel + kFrameBar,
                               .bottom = kFrameBottom,
                               .width = kFrameKeyWidth,
                               .height = kFramePanel};

// The room for a colour bar right of the last panel.
constexpr double kStripBar = 110.0;

constexpr std::string_view kAlongProxyPath = "along the proxy's path (mm)";
constexpr std::string_view kAlongCommonNormal = "along the contact normal (mm)";

// Returns the common field behind ticks on a formula.
std::optional<FieldPicture> common_field(std::span<const TickSteps> ticks,
                                         std::span<const rendering::Object> objects,
                                         const TickView& view, const Window& window, double pixels,
                                         const GnuplotFolder& folder) {
  const auto formula = tracked_formula(ticks, objects);
  return formula ? std::optional(draw_field(*formula->surface, view, window, formula->tolerance_m,
                                            static_cast<std::size_t>(pixels), "common", folder))
                 : std::nullopt;
}

}  // namespace

void draw_tick_strip(std::span<const TickSteps> ticks, std::span<const rendering::Object> objects,
                     const std::string& title, const std::filesystem::path& picture) {
  const GnuplotFolder folder;
  const TickView view(ticks, false);
  const Window window = view.window(ticks);
  const std::optional<FieldPicture> field =
      common_field(ticks, objects, view, window, kStripPanel, folder);
  const auto count = static_cast<double>(ticks.size());
  const double width = kStripLeft + count * kStripPanel + (count - 1.0) * kStripGap + kStripRight +
                       (field ? kStripBar : 0.0);
  const PictureSize sheet{.width_px = std::max(width, kStripLeastWidth),
                          .height_px = kStripBottom + kStripPanel + kStripTop};
  std::string script = tick_head(sheet, kStripLeft, title, "");
  const double step_mm = round_step(window.width() / kStripTics);
  script += fmt::format("set xtics {0:.6g}\nset ytics {0:.6g}\n", step_mm);
  for (std::size_t i = 0; i < ticks.size(); ++i) {
    const bool is_first = i == 0;
    const bool is_last = i + 1 == ticks.size();
    const TickPanel panel{
        .tick = ticks[i],
        .view = view,
        .window = window,
        .place = {.left = kStripLeft + static_cast<double>(i) * (kStripPanel + kStripGap),
                  .bottom = kStripBottom,
                  .width = kStripPanel,
                  .height = kStripPanel},
        .suffix = fmt::format("{}", i),
        .title = fmt::format("tick {}, {:.6g} s", ticks[i].number, ticks[i].t_s),
        .x_label = std::string(kAlongProxyPath),
        .y_label = std::string(is_first ? kAlongCommonNormal : ""),
        .field = field ? &*field : nullptr};
    script += is_first ? "set format y \"% h\"\n" : "set format y \"\"\n";
    script += field && is_last ? colour_bar(sheet, panel.place) : "unset colorbox\n";
    script += tick_panel(panel, objects, sheet);
  }
  script += tick_key(sheet, foot_of(sheet, kStripKeyHeight), field.has_value());
  run_gnuplot(folder, sheet, script, picture);
}

TickFrames::TickFrames(std::span<const TickSteps> ticks, std::span<const rendering::Object> objects,
                       std::string title)
    : ticks_(ticks),
      objects_(objects),
      title_(std::move(title)),
      view_(ticks, false),
      window_(view_.window(ticks)),
      field_(common_field(ticks, objects, view_, window_, kFramePanel, folder_)) {}

void TickFrames::draw(std::size_t index, const std::filesystem::path& picture) const {
  const TickSteps& tick = ticks_[index];
  const TickPanel panel{.tick = tick,
                        .view = view_,
                        .window = window_,
                        .place = {.left = kFrameLeft,
                                  .bottom = kFrameBottom,
                                  .width = kFramePanel,
                                  .height = kFramePanel},
                        .suffix = "frame",
                        .title = {},
                        .x_label = std::string(kAlongProxyPath),
                        .y_label = std::string(kAlongCommonNormal),
                        .field = field_ ? &*field_ : nullptr};
  std::string script = tick_head(
      kFrameSheet, kFrameLeft,
      fmt::format("{}: tick {} at {:.6g} s", title_, tick.number, tick.t_s), facts_of(tick));
  script += field_ ? colour_bar(kFrameSheet, panel.place) : "";
  script += tick_panel(panel, objects_, kFrameSheet);
  PanelPlace key = kFrameKey;
  key.left -= field_ ? 0.0 : kFrameBar / 2.0;
  script += tick_key(kFrameSheet, key, field_.has_value());
  run_gnuplot(folder_, kFrameSheet, script, picture);
}

}  // namespace tactus::host
