// Curves in panels, one above the other, as a PNG file.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace tactus::host {

enum class CurveStyle { line, dashes, points, faint_points, line_with_points };

struct Curve {
  std::string name;  // in the key; empty: not there
  std::vector<double> x;
  std::vector<double> y;  // as many
  CurveStyle style = CurveStyle::line;
};

struct Panel {
  std::string x_label;  // with its unit
  std::string y_label;
  std::vector<Curve> curves;
};

// Throws InputError when gnuplot is missing or fails.
void draw_panels(const std::string& title, std::span<const Panel> panels,
                 const std::filesystem::path& png);

}  // namespace tactus::host
