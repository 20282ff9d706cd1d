// Draws ticks as the lecture's slides do: the moves of the proxy, the planes that bound them, and
// the friction cone; on an implicit surface the iterations over the formula's field.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "host_tools/plot/tick_panel.h"

namespace tactus::host {

// Draws the tick in two views: across the surface, in the plane of the contact normal and of the
// tool's pull along the surface, with the objects cut open; and from above, along the normal, with
// the friction circles. A tick that iterates on a formula is drawn across the surface twice, over
// the formula's field: as a whole, and close to its last iterations. Objects that move are drawn
// where the scene gives them. Throws InputError if gnuplot is missing or fails, or the scene has no
// such formula.
void draw_tick_figure(const TickSteps& tick, std::span<const rendering::Object> objects,
                      const std::string& title, const std::filesystem::path& picture);

// A strip has at most so many ticks: smaller panels could not be read.
inline constexpr std::size_t kMostStripTicks = 8;

// Draws several ticks in a row across the surface, with common axes. Throws InputError as above.
void draw_tick_strip(std::span<const TickSteps> ticks, std::span<const rendering::Object> objects,
                     const std::string& title, const std::filesystem::path& picture);

// Pictures of the ticks of a stroke, across the surface with common axes, to be shown one after the
// other.
class TickFrames {
 public:
  // `ticks` and `objects` must outlive this. Throws InputError if the scene has no such formula.
  TickFrames(std::span<const TickSteps> ticks, std::span<const rendering::Object> objects,
             std::string title);

  // Draws a frame by its index. Throws InputError if gnuplot is missing or fails.
  void draw(std::size_t index, const std::filesystem::path& picture) const;

 private:
  std::span<const TickSteps> ticks_;
  std::span<const rendering::Object> objects_;
  std::string title_;
  TickView view_;
  Window window_;
  GnuplotFolder folder_;
  std::optional<FieldPicture> field_;
};

}  // namespace tactus::host
