// Cuts through the reach of a device: the places of the figure, sampled.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "host_tools/reach/reach_map.h"

namespace tactus::host {

// A cut through the workspace: two axes of B, 0 to 2, and the names of its picture's axes.
struct ReachCut {
  Eigen::Index right = 0;
  Eigen::Index up = 1;
  std::string_view right_label;
  std::string_view up_label;
  // True: the second axis points down, as toward a user who looks from above.
  bool is_down = false;
};

// Returns the cuts that show a device with so many joints.
std::vector<ReachCut> cuts_of(std::size_t joints);

// The window of a cut, mm, and the distance of its places.
struct CutWindow {
  double right_mm = 0.0;
  double up_mm = 0.0;
  double width_mm = 0.0;
  double height_mm = 0.0;
  double step_mm = 0.0;
};

// Returns the window around the box, with a margin.
CutWindow window_of(const ReachCut& cut, const ReachBox& box);

// One sampled cut: gnuplot's rows, and every value for the range of the colours.
struct SampledCut {
  std::string resolution_um;
  std::string force_N;
  std::vector<double> resolutions_um;
  std::vector<double> forces_N;
};

// Returns the cut of a device whose handle moves in all of it.
SampledCut sample_plane(const ReachMap& map, const ReachCut& cut, const CutWindow& window);
// Returns the places of a device with one joint, whose handle moves on an arc.
SampledCut sample_arc(const ReachMap& map);

}  // namespace tactus::host
