// A one-sided square floor at y = 0, 2 m wide, its front up.
#pragma once

#include <array>

#include "rendering/objects/object.h"
#include "rendering/world/world.h"

namespace tactus::firmware {

class Floor {
 public:
  explicit Floor(const rendering::Material& material) {
    objects_[0].mesh = {vertices_, triangles_, nodes_};
    objects_[0].material = material;
  }
  Floor(const Floor&) = delete;
  Floor& operator=(const Floor&) = delete;
  ~Floor() = default;

  [[nodiscard]] std::span<const rendering::Object> objects() const { return objects_; }

 private:
  std::array<rendering::Float3, 4> vertices_ = {
      {{-1.0F, 0.0F, -1.0F}, {-1.0F, 0.0F, 1.0F}, {1.0F, 0.0F, 1.0F}, {1.0F, 0.0F, -1.0F}}};
  std::array<rendering::TriangleIndices, 2> triangles_ = {{{0, 1, 2}, {0, 2, 3}}};
  std::array<rendering::BvhNode, 1> nodes_ = {{{.lower = {-1.0F, 0.0F, -1.0F},
                                                .first = 0,
                                                .upper = {1.0F, 0.0F, 1.0F},
                                                .triangle_count = 2}}};
  std::array<rendering::Object, 1> objects_;
};

}  // namespace tactus::firmware
