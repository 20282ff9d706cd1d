// The colours of the types, for pictures and for Graphviz: those of Okabe and Ito, "Color universal
// design" (2008), which people who see no red or no green can tell apart.
#pragma once

#include <array>
#include <string_view>

#include "host_tools/graph/connection_graph.h"

namespace tactus::host {

inline constexpr std::string_view kGraphBlue = "#0072b2";
inline constexpr std::string_view kGraphVermilion = "#d55e00";
inline constexpr std::string_view kGraphOrange = "#e69f00";
inline constexpr std::string_view kGraphPurple = "#a0407a";
inline constexpr std::string_view kGraphGrey = "#8a8a8a";
inline constexpr std::string_view kGraphBlack = "#000000";

// Return the colour as gnuplot, Graphviz and SVG take it.
constexpr std::string_view colour_of(ConnectionType type) {
  constexpr std::array<std::string_view, kConnectionTypes> kColours = {
      kGraphBlue, kGraphVermilion, kGraphGrey, kGraphPurple, kGraphBlack, kGraphBlack};
  return kColours[static_cast<std::size_t>(type)];
}
constexpr std::string_view colour_of(CornerType type) {
  constexpr std::array<std::string_view, kCornerTypes> kColours = {
      kGraphBlue, kGraphVermilion, kGraphOrange, kGraphGrey, kGraphPurple, kGraphBlack};
  return kColours[static_cast<std::size_t>(type)];
}

}  // namespace tactus::host
