// A shape with corner normals, and with a texture, ready for a World.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "host_tools/bake/scene/corner_normals.h"
#include "host_tools/bake/scene/mesh_bake.h"
#include "host_tools/bake/scene/mip_pyramid.h"
#include "rendering/contact/tick_watcher.h"
#include "rendering/world/world.h"
#include "tests/support/shapes.h"

namespace tactus::testing {

class ShadedSolid {
 public:
  ShadedSolid(const Shape& shape, double angle_limit_deg, const rendering::Material& material)
      : mesh_(host::bake_mesh(shape.vertices, shape.triangles)),
        corners_(host::corner_normals(mesh_.vertices, mesh_.triangles, mesh_.neighbours,
                                      angle_limit_deg * std::numbers::pi / 180.0)) {
    flat_ = {.mesh = mesh_.view(),
             .neighbours = mesh_.neighbours,
             .vertex_normals = mesh_.vertex_normals,
             .material = material};
  }

  [[nodiscard]] const rendering::Object& flat() const { return flat_; }
  [[nodiscard]] rendering::Object shaded() const {
    rendering::Object object = flat_;
    object.detail.corner_normals = corners_;
    return object;
  }
  [[nodiscard]] const std::vector<rendering::CornerNormals>& corners() const { return corners_; }
  [[nodiscard]] const host::BakedMesh& mesh() const { return mesh_; }

 private:
  host::BakedMesh mesh_;
  std::vector<rendering::CornerNormals> corners_;
  rendering::Object flat_;
};

// One tool in a world of one object.
class Hand {
 public:
  Hand(rendering::Object object, double radius_m) : object_(std::move(object)) {
    EXPECT_TRUE(world_->set_scene({&object_, 1}, {.tool_radius_m = radius_m}));
  }
  rendering::Touch touch(const Vec3& tool, rendering::TickWatcher* watcher = nullptr) {
    return world_->touch({.p_W = tool}, watcher);
  }

 private:
  rendering::Object object_;
  std::unique_ptr<rendering::World> world_ = std::make_unique<rendering::World>();
};

// A picture made by colour(u, v), each channel 0 to 1, as the layer of an object. Grey takes the
// first channel.
class Picture {
 public:
  template <class Colour>
  Picture(const rendering::TextureLayer& layer, std::uint32_t side, const Colour& colour)
      : layer_(layer) {
    layer_.width = side;
    layer_.height = side;
    std::vector<std::uint8_t> texels;
    for (std::uint32_t y = 0; y < side; ++y) {
      for (std::uint32_t x = 0; x < side; ++x) {
        const Vec3 value = colour((x + 0.5) / side, 1.0 - (y + 0.5) / side);
        for (int channel = 0; channel < static_cast<int>(layer.format); ++channel) {
          texels.push_back(static_cast<std::uint8_t>(std::lround(255.0 * value[channel])));
        }
      }
    }
    texels_ = host::build_mip_pyramid(texels, {side, side}, layer.format);
  }

  [[nodiscard]] rendering::Object on(rendering::Object object) const {
    object.detail.layers = {&layer_, 1};
    object.detail.texels = texels_;
    return object;
  }

 private:
  rendering::TextureLayer layer_;
  std::vector<std::uint8_t> texels_;
};

}  // namespace tactus::testing
