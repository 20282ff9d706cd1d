// One view of one tick as a panel of a figure: moves, planes, friction cone and circles, and behind
// them the objects cut open or a formula's field. Every figure of ticks consists of such panels.
#pragma once

#include <span>
#include <string>

#include "host_tools/plot/field_picture.h"
#include "host_tools/plot/gnuplot.h"
#include "host_tools/plot/tick_steps.h"
#include "host_tools/plot/tick_view.h"
#include "rendering/objects/object.h"

namespace tactus::host {

// A panel's axes on the sheet, pixels from the lower left corner.
struct PanelPlace {
  double left = 0.0;
  double bottom = 0.0;
  double width = 0.0;
  double height = 0.0;
};

// The contents of a panel and its place. The members that are references must outlive it.
struct TickPanel {
  const TickSteps& tick;
  const TickView& view;
  bool from_above = false;
  // The axes, mm.
  Window window;
  PanelPlace place;
  // Ends the names of its data blocks; every panel of a sheet has another one.
  std::string suffix;
  // Above the panel; empty for none.
  std::string title;
  std::string x_label;
  std::string y_label;
  // The field behind it, or nullptr.
  const FieldPicture* field = nullptr;
  // True if the moves are numbered at their ends.
  bool has_numbers = false;
};

// Returns the script that draws the panel. `objects` are those of the scene, where it gives them.
std::string tick_panel(const TickPanel& panel, std::span<const rendering::Object> objects,
                       const PictureSize& sheet);

// Returns one line of what the pictures of a tick cannot show.
std::string facts_of(const TickSteps& tick);

}  // namespace tactus::host
