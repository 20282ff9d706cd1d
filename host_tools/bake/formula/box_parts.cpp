#include "host_tools/bake/formula/box_parts.h"

namespace tactus::host {

using rendering::Box;

Vec3 middle_of(const Box& box) {
  return 0.5 * (box.lower + box.upper);
}

double size_of(const Box& box) {
  return (box.upper - box.lower).maxCoeff();
}

// Returns the halves of a box across its longest side.
std::array<Box, 2> halves_of(const Box& box) {
  int axis = 0;
  (box.upper - box.lower).maxCoeff(&axis);
  std::array halves{box, box};
  halves[0].upper[axis] = halves[1].lower[axis] = middle_of(box)[axis];
  return halves;
}

void BoxParts::add(const Box& box, double height) {
  by_height_.emplace(-height, parts_.size());
  by_size_.emplace(size_of(box), parts_.size());
  parts_.push_back({.box = box});
  ++left_;
}

Box BoxParts::take(bool largest) {
  Queue& queue = largest ? by_size_ : by_height_;
  while (parts_[queue.top().second].is_taken) {
    queue.pop();
  }
  Part& part = parts_[queue.top().second];
  part.is_taken = true;
  --left_;
  return part.box;
}

}  // namespace tactus::host
