// Writes baked meshes as a scene image (rendering/scene/scene.fbs).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "host_tools/bake/scene/mesh_bake.h"
#include "host_tools/bake/scene/motion_description.h"
#include "host_tools/bake/scene/shape_description.h"
#include "rendering/effects/effect.h"
#include "rendering/objects/object.h"

namespace tactus::host {

// Pictures on a surface, with their coarser levels.
struct BakedTextures {
  std::vector<rendering::TextureLayer> layers;
  std::vector<std::uint8_t> texels;
};

struct BakedObject {
  std::string name;
  rendering::Sides sides = rendering::Sides::one;
  rendering::Material material;
  BakedMesh mesh;
  ShapeDescription shape;
  Placement placement;  // of the shape
  rendering::ContactMethod contact = rendering::ContactMethod::sphere_proxy;
  BakedTextures textures;
  MotionDescription motion;
};

struct BakedScene {
  double tool_radius_m = 0.0;
  std::size_t tool_count = 1;  // 1 to kMaxTools
  std::vector<BakedObject> objects;
  std::vector<rendering::Effect> effects;
};

// Returns the bytes that an object's arrays take in the image.
std::uint64_t image_bytes(const BakedMesh& mesh);

// The whole image, ready for SceneImage::open; the same scene gives the same bytes. Throws
// InputError when the scene is too large for the format (2 GiB) or has too many objects.
std::vector<std::byte> write_image(const BakedScene& scene);

}  // namespace tactus::host
