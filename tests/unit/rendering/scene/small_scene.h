// A scene of two tetrahedra, small enough to damage in every way there is.
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <cstring>
#include <span>
#include <vector>

#include "host_tools/bake/scene/image_writer.h"
#include "host_tools/bake/scene/mesh_bake.h"
#include "rendering/scene/image_format.h"
#include "rendering/scene/scene_image.h"

namespace tactus::testing {

inline host::BakedMesh tetrahedron(float size_m) {
  const std::vector<rendering::Float3> vertices{
      {0, 0, 0}, {size_m, 0, 0}, {0, size_m, 0}, {0, 0, size_m}};
  const std::vector<rendering::TriangleIndices> triangles{
      {0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  return host::bake_mesh(vertices, triangles);
}

inline host::BakedScene small_scene() {
  return {.tool_radius_m = 0.002,
          .objects = {
              {.name = "left",
               .sides = rendering::Sides::one,
               .material = {.stiffness_N_per_m = 800.0,
                            .damping_Ns_per_m = 0.5,
                            .friction = rendering::cone_friction(0.6, 0.4)},
               .mesh = tetrahedron(0.1F)},
              {.name = "right",
               .sides = rendering::Sides::two,
               .material = {.stiffness_N_per_m = 300.0, .damping_Ns_per_m = 0.0, .friction = {}},
               .mesh = tetrahedron(0.2F)}}};
}

// The same with all that a scene may have beside.
inline host::BakedScene detailed_scene() {
  host::BakedScene scene = small_scene();
  scene.tool_count = 2;
  scene.effects = {
      {.law = rendering::Spring{.stiffness_N_per_m = 5.0}, .max_force_N = 1.0},
      {.law = rendering::FluidDrag{.volume = {.dimensions_m = {0.1}}, .linear_Ns_per_m = 1.0},
       .max_force_N = 1.0}};
  host::BakedObject& object = scene.objects[0];
  object.motion.moves = true;
  object.mesh.corner_normals.resize(object.mesh.triangles.size());
  object.mesh.corner_places.resize(object.mesh.triangles.size(), {{{0, 0}, {1, 0}, {0, 1}}});
  object.textures.layers = {{.use = rendering::TextureUse::bump,
                             .projection = rendering::TextureProjection::uv,
                             .width = 4,
                             .height = 4,
                             .high = 0.001},
                            {.use = rendering::TextureUse::normal,
                             .format = rendering::TextureFormat::rgb,
                             .width = 2,
                             .height = 1,
                             .first_byte = 21,
                             .tile_m = 0.01}};
  object.textures.texels.resize(21 + 9, 100);
  return scene;
}

// Returns the error of an image that must be refused.
inline rendering::SceneError error_of(std::span<const std::byte> bytes) {
  const auto image = rendering::SceneImage::open(bytes);
  EXPECT_FALSE(image.has_value());
  return image ? rendering::SceneError{} : image.error();
}
inline rendering::SceneError error_of(const host::BakedScene& scene) {
  return error_of(host::write_image(scene));
}

// Makes a changed image's checksum right again.
inline void seal(std::span<std::byte> image) {
  rendering::ImageHeader header;
  std::memcpy(&header, image.data(), sizeof(header));
  header.checksum = rendering::image_checksum(header, image.subspan(sizeof(header)));
  std::memcpy(image.data(), &header, sizeof(header));
}

}  // namespace tactus::testing
