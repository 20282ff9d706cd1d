// A shape made ready for a World: hierarchy built, triangles in its order. Keeps what the Object
// points into alive.
#pragma once

#include <vector>

#include "rendering/objects/object.h"
#include "tests/support/shapes.h"

namespace tactus::testing {

class Solid {
 public:
  Solid(Shape shape, rendering::Sides sides, const rendering::Material& material);

  [[nodiscard]] const rendering::Object& object() const { return object_; }
  [[nodiscard]] const Shape& shape() const { return shape_; }

 private:
  Shape shape_;
  std::vector<rendering::BvhNode> nodes_;
  rendering::Object object_;
};

}  // namespace tactus::testing
