// A scene of many objects of which only one is touched, to measure the cost of the others.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "host_tools/bake/scene/mesh_bake.h"
#include "rendering/objects/object.h"

namespace tactus::host {

// Balls of 10 mm radius at distances of 30 mm, filling a cube around the first one at the origin.
// Every second ball is a primitive, the others are meshes of 320 triangles.
class Crowd {
 public:
  explicit Crowd(std::size_t count);

  // Returns the objects, which view this crowd's meshes.
  [[nodiscard]] std::span<const rendering::Object> objects() const { return objects_; }

 private:
  std::vector<BakedMesh> meshes_;
  std::vector<rendering::Object> objects_;
};

}  // namespace tactus::host
