#include "host_tools/reach/reach_cut.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>
#include <utility>

namespace tactus::host {
namespace {

// Places along the longer side of a cut.
constexpr int kReachSide = 161;

constexpr std::string_view kXLabel = "x (mm), to the right";
constexpr std::string_view kYLabel = "y (mm), up";
constexpr std::string_view kZLabel = "z (mm), toward the user";
constexpr ReachCut kFromLeft{
    .right = 2, .up = 1, .right_label = kZLabel, .up_label = kYLabel, .is_down = false};
constexpr ReachCut kFromUser{
    .right = 0, .up = 1, .right_label = kXLabel, .up_label = kYLabel, .is_down = false};
constexpr ReachCut kFromAbove{
    .right = 0, .up = 2, .right_label = kXLabel, .up_label = kZLabel, .is_down = true};

void add_place(const std::optional<ReachPoint>& point, double right_mm, double up_mm,
               SampledCut& cut) {
  const double resolution_um = point ? 1e6 * point->resolution_m : 0.0;
  for (const auto& [text, value] : {std::pair{&cut.resolution_um, resolution_um},
                                    std::pair{&cut.force_N, point ? point->force_N : 0.0}}) {
    if (point) {
      fmt::format_to(std::back_inserter(*text), "{:.5g} {:.5g} {:.5g}\n", right_mm, up_mm, value);
    } else {
      fmt::format_to(std::back_inserter(*text), "{:.5g} {:.5g} NaN\n", right_mm, up_mm);
    }
  }
  if (point) {
    cut.resolutions_um.push_back(resolution_um);
    cut.forces_N.push_back(point->force_N);
  }
}

}  // namespace

std::vector<ReachCut> cuts_of(std::size_t joints) {
  switch (joints) {
    case 1:
      return {kFromUser};
    case 2:
      return {kFromAbove};
    default:
      return {kFromLeft, kFromUser};
  }
}

CutWindow window_of(const ReachCut& cut, const ReachBox& box) {
  constexpr double kMargin = 0.06;
  const Vec3 size_mm = 1e3 * (box.upper_B - box.lower_B);
  const double margin_mm = kMargin * std::max(size_mm[cut.right], size_mm[cut.up]);
  CutWindow window{.right_mm = 1e3 * box.lower_B[cut.right] - margin_mm,
                   .up_mm = 1e3 * box.lower_B[cut.up] - margin_mm,
                   .width_mm = size_mm[cut.right] + 2.0 * margin_mm,
                   .height_mm = size_mm[cut.up] + 2.0 * margin_mm};
  window.step_mm = std::max(window.width_mm, window.height_mm) / (kReachSide - 1);
  return window;
}

SampledCut sample_plane(const ReachMap& map, const ReachCut& cut, const CutWindow& window) {
  SampledCut sampled;
  const int columns = static_cast<int>(window.width_mm / window.step_mm) + 1;
  const int rows = static_cast<int>(window.height_mm / window.step_mm) + 1;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const double right_mm = window.right_mm + column * window.step_mm;
      const double up_mm = window.up_mm + row * window.step_mm;
      Vec3 p_B = map.device().centre_B;
      p_B[cut.right] = 1e-3 * right_mm;
      p_B[cut.up] = 1e-3 * up_mm;
      add_place(map.at(p_B), right_mm, up_mm, sampled);
    }
    sampled.resolution_um += "\n";
    sampled.force_N += "\n";
  }
  return sampled;
}

SampledCut sample_arc(const ReachMap& map) {
  constexpr int kPlaces = 721;
  SampledCut sampled;
  const PlantMechanism& mechanism = map.device().device.plant.mechanism;
  for (int i = 0; i < kPlaces; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / (kPlaces - 1);
    const Vec3 p_B = on_manifold(mechanism, {std::sin(angle), std::cos(angle), 0.0});
    if (const auto point = map.at(p_B)) {
      add_place(point, 1e3 * p_B.x(), 1e3 * p_B.y(), sampled);
    }
  }
  return sampled;
}

}  // namespace tactus::host
