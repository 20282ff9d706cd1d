// Draws curves in panels, one above the other, as a picture. Friction, certify and the benchmark
// use it.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace tactus::host {

// How a curve is drawn.
enum class CurveStyle { line, dashes, points, faint_points, line_with_points };

// A curve; x and y have equally many values.
struct Curve {
  // Its name in the key; empty: it is not in the key.
  std::string name;
  std::vector<double> x;
  std::vector<double> y;
  CurveStyle style = CurveStyle::line;
};

// Curves over common axes.
struct Panel {
  // With its unit, like the other.
  std::string x_label;
  std::string y_label;
  // Drawn in their order; later ones lie over earlier ones.
  std::vector<Curve> curves;
};

// Draws the panels below a title. Throws InputError if gnuplot is missing or fails.
void draw_panels(const std::string& title, std::span<const Panel> panels,
                 const std::filesystem::path& picture);

}  // namespace tactus::host
