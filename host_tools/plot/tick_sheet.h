// The parts that the figures of ticks have in common: the title, the key and the formula's field.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "host_tools/plot/tick_panel.h"

namespace tactus::host {

// Returns the script of the title, and of the line of facts below it, above panels that begin at
// `left`, pixels.
std::string tick_head(const PictureSize& sheet, double left, const std::string& title,
                      const std::string& facts);

// Returns the script of the key in a place of its own: in rows if that is wide, else in a column.
std::string tick_key(const PictureSize& sheet, const PanelPlace& place, bool has_field);

// Returns the place of a key below the panels, so many pixels high.
PanelPlace foot_of(const PictureSize& sheet, double height);

// Returns the commands that place a colour bar for the field right of a panel, with or without its
// name.
std::string colour_bar(const PictureSize& sheet, const PanelPlace& panel, bool has_label = true);

// The formula on which ticks iterate, and the height above it at which a proxy is in contact.
struct TrackedFormula {
  // Points into the scene.
  const rendering::ImplicitSurface* surface = nullptr;
  double tolerance_m = 0.0;
};

// Returns the formula on which the ticks iterate; nothing if they do not. Throws InputError if the
// scene has none as the object of that number.
std::optional<TrackedFormula> tracked_formula(std::span<const TickSteps> ticks,
                                              std::span<const rendering::Object> objects);

}  // namespace tactus::host
