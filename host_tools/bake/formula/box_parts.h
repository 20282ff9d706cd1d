// Parts of a box, for searches that halve it again and again.
#pragma once

#include <array>
#include <cstddef>
#include <queue>
#include <utility>
#include <vector>

#include "rendering/surface/implicit_surface.h"

namespace tactus::host {

// Return the middle of a box and the length of its longest side.
Vec3 middle_of(const rendering::Box& box);
double size_of(const rendering::Box& box);

// Returns the halves of a box across its longest side.
std::array<rendering::Box, 2> halves_of(const rendering::Box& box);

// The parts of a box that are still to be looked at. Each has a height, which tells how far the
// formula is from 0 there.
class BoxParts {
 public:
  void add(const rendering::Box& box, double height);
  [[nodiscard]] bool is_empty() const { return left_ == 0; }
  // Takes the largest part out, or the one with the least height. There must be one.
  rendering::Box take(bool largest);

 private:
  struct Part {
    rendering::Box box;
    bool is_taken = false;
  };
  using Queue = std::priority_queue<std::pair<double, std::size_t>>;

  std::vector<Part> parts_;
  // The numbers of the parts; those that are taken are passed over.
  Queue by_height_;
  Queue by_size_;
  std::size_t left_ = 0;
};

}  // namespace tactus::host
