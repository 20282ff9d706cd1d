// Many objects of which one is touched: what the others cost.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "host_tools/bake/scene/mesh_bake.h"
#include "rendering/objects/object.h"

namespace tactus::host {

// Balls of 10 mm radius, 30 mm apart, filling a cube round the first, which is at the origin; every
// second of the others is a primitive, the rest are meshes of 320 triangles like the first.
class Crowd {
 public:
  explicit Crowd(std::size_t count);

  [[nodiscard]] std::span<const rendering::Object> objects() const { return objects_; }

 private:
  std::vector<BakedMesh> meshes_;
  std::vector<rendering::Object> objects_;
};

}  // namespace tactus::host
