#include "host_tools/plot/field_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <vector>

namespace tactus::host {
namespace {

// The bands' colours from the lowest values, in the solid, to the highest: two hues, darker away
// from zero. The colours are pale enough to draw over.
constexpr auto kBandColours =
    std::to_array<std::uint32_t>({0xc8943c, 0xd8ae62, 0xe5c68a, 0xefdcb4, 0xf8f1e0, 0xe6f3f1,
                                  0xc6e5e1, 0xa3d4ce, 0x7cbfb8, 0x55a8a0});
constexpr std::uint32_t kNoField = 0xffffff;
constexpr std::uint32_t kInTolerance = 0xffe27a;
constexpr double kBandsEachSide = 5.0;

// The heights of the bands below and above zero.
struct BandSteps {
  double below = 1.0;
  double above = 1.0;
};

// Returns the height of a band, 1, 2 or 5 times a power of ten, with which nine tenths of the sizes
// lie within the bands; nothing without sizes.
std::optional<double> step_for(std::vector<double>& sizes) {
  constexpr double kWithin = 0.9;
  if (sizes.empty()) {
    return std::nullopt;
  }
  const auto most =
      sizes.begin() + static_cast<std::ptrdiff_t>(kWithin * static_cast<double>(sizes.size() - 1));
  std::ranges::nth_element(sizes, most);
  return round_step(*most / kBandsEachSide);
}

// Returns the bands' heights: one for both sides, or one for each where the values of one side
// would vanish in a band of the other.
BandSteps band_steps(const FieldGrid& grid) {
  constexpr double kAlike = 4.0;
  std::vector<double> below;
  std::vector<double> above;
  for (const double value : grid.values) {
    if (std::isfinite(value)) {
      (value < 0.0 ? below : above).push_back(std::abs(value));
    }
  }
  const std::optional<double> low = step_for(below);
  const std::optional<double> high = step_for(above);
  const BandSteps steps{.below = low.value_or(high.value_or(1.0)),
                        .above = high.value_or(low.value_or(1.0))};
  const double larger = std::max(steps.below, steps.above);
  return larger > kAlike * std::min(steps.below, steps.above)
             ? steps
             : BandSteps{.below = larger, .above = larger};
}

std::uint32_t colour_of(double value, const BandSteps& steps) {
  const double step = value < 0.0 ? steps.below : steps.above;
  const double band = std::clamp(std::floor(value / step), -kBandsEachSide, kBandsEachSide - 1.0);
  return kBandColours.at(static_cast<std::size_t>(band + kBandsEachSide));
}

std::string contour_block(const std::string& name, const FieldGrid& grid, double level) {
  std::string block = fmt::format("${} << EOD\n", name);
  for (const auto& [a, b] : contour_of(grid, level)) {
    fmt::format_to(std::back_inserter(block), "{:.7g} {:.7g}\n{:.7g} {:.7g}\n\n", a.right, a.up,
                   b.right, b.up);
  }
  return block + "1e9 1e9\nEOD\n";
}

// Returns the palette of the colour bar, which counts bands; the last data block is a point off the
// sheet, for which gnuplot draws the bar.
std::string palette(const BandSteps& steps, const std::string& name) {
  std::string colours;
  for (std::size_t i = 0; i < kBandColours.size(); ++i) {
    colours += fmt::format("{}{} \"#{:06x}\"", i == 0 ? "" : ", ", i, kBandColours[i]);
  }
  std::string labels;
  for (double band = -kBandsEachSide; band <= kBandsEachSide; band += 1.0) {
    labels += fmt::format("{}\"{:.4g}\" {}", labels.empty() ? "" : ", ",
                          band * (band < 0.0 ? steps.below : steps.above), band);
  }
  return fmt::format(
      "set palette maxcolors {} defined ({})\nset cbrange [{}:{}]\nset cbtics ({})\n"
      "$off_{} << EOD\n1e9 1e9 0\nEOD\n",
      kBandColours.size(), colours, -kBandsEachSide, kBandsEachSide, labels, name);
}

}  // namespace

FieldPicture draw_field(const rendering::ImplicitSurface& surface, const TickView& view,
                        const Window& window, double tolerance_m, std::size_t pixels,
                        const std::string& name, const GnuplotFolder& folder) {
  // A narrower band is only a line.
  constexpr double kLeastBand_px = 2.0;
  const FieldGrid field = sample_field(surface, view, window, pixels);
  const double pixel_mm = window.width() / static_cast<double>(pixels);
  const bool has_band = 1e3 * tolerance_m > kLeastBand_px * pixel_mm;
  const FieldGrid height = has_band ? sample_height(surface, view, window, pixels) : FieldGrid{};
  const BandSteps steps = band_steps(field);
  std::string bytes;
  bytes.reserve(3 * field.values.size());
  for (std::size_t i = 0; i < field.values.size(); ++i) {
    const bool in_band = has_band && height.values[i] >= 0.0 && height.values[i] <= tolerance_m;
    const std::uint32_t colour = std::isnan(field.values[i]) ? kNoField
                                 : in_band                   ? kInTolerance
                                                             : colour_of(field.values[i], steps);
    for (const std::uint32_t shift : {16U, 8U, 0U}) {
      bytes += static_cast<char>(colour >> shift & 0xffU);
    }
  }
  const std::filesystem::path file = folder.path() / fmt::format("field_{}.rgb", name);
  write_raw_rgb(file, bytes);
  const auto side = static_cast<int>(pixels);
  FieldPicture picture;
  picture.head = contour_block("zero_" + name, field, 0.0) + palette(steps, name);
  picture.items = fmt::format(
      "{}, $off_{} using 1:2:3 with points palette, $zero_{} using 1:2 with lines linecolor "
      "\"#111111\" linewidth 3, ",
      rgb_item(file, side, side, window), name, name);
  if (has_band) {
    picture.head += contour_block("tolerance_" + name, height, tolerance_m);
    picture.items += fmt::format(
        "$tolerance_{} using 1:2 with lines linecolor \"#a8790a\" linewidth 1.2, ", name);
  }
  return picture;
}

}  // namespace tactus::host
