// Finds places for labels in a picture, so that nothing is printed over.
#pragma once

#include <optional>
#include <vector>

#include "host_tools/graph/graph_view.h"

namespace tactus::host {

// A rectangle about its middle, in pixels.
struct LabelBox {
  PlanePoint middle;
  double width = 0.0;
  double height = 0.0;
};

// The places of a picture that are taken by labels and lines.
class LabelPlaces {
 public:
  // Takes the place of a mark, whether it is free or not.
  void take(const LabelBox& box) { boxes_.push_back(box); }
  // Keeps labels off a line.
  void keep_off(const PixelLine& line) { lines_.push_back(line); }

  // Returns true if no mark or label is in the box.
  [[nodiscard]] bool is_free_of_labels(const LabelBox& box) const;
  // Takes a place of this size beside a point: in one of eight directions, near to it, free of
  // labels and lines. Returns its middle; nothing if all are taken.
  std::optional<PlanePoint> take_beside(const PlanePoint& point, double width, double height);

 private:
  [[nodiscard]] bool is_free_of_lines(const LabelBox& box) const;

  std::vector<LabelBox> boxes_;
  std::vector<PixelLine> lines_;
};

}  // namespace tactus::host
