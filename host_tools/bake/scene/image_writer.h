// Writes a baked scene as an image (rendering/scene/scene.fbs). bake.h calls it last; tests use it
// to make images in memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "host_tools/bake/scene/body_bake.h"
#include "host_tools/bake/scene/mesh_bake.h"
#include "host_tools/bake/scene/motion_description.h"
#include "host_tools/bake/scene/shape_description.h"
#include "rendering/effects/effect.h"
#include "rendering/needle/tissue.h"
#include "rendering/objects/object.h"

namespace tactus::host {

// The pictures on a surface, each with its coarser levels.
struct BakedTextures {
  // How each picture is used, and where its bytes begin in `texels`.
  std::vector<rendering::TextureLayer> layers;
  // The texels of all pictures, one after the other.
  std::vector<std::uint8_t> texels;
};

// An object with everything that the controller needs of it.
struct BakedObject {
  std::string name;
  // The sides from which the surface is touched.
  rendering::Sides sides = rendering::Sides::one;
  // Stiffness, damping, friction and grain.
  rendering::Material material;
  // The mesh that is touched, or the picture of the shape.
  BakedMesh mesh;
  // The primitive or formula that is touched; nothing for a mesh.
  ShapeDescription shape;
  // The place of the shape in the world; a mesh is in the world frame already.
  Placement placement;
  // The method that renders the contact; the shape must permit it.
  rendering::ContactMethod contact = rendering::ContactMethod::sphere_proxy;
  // The height above a facet where the textbook's methods put their point, m.
  double push_out_m = rendering::kDefaultPushOut_m;
  BakedTextures textures;
  // How the object moves by itself and whether it may be moved or deformed.
  MotionDescription motion;
  // The body that moves by forces; nothing for an object that is none.
  std::optional<BakedBody> body = std::nullopt;
  // The tissue of a layer that a needle pierces; none for other objects.
  std::optional<rendering::Tissue> tissue = std::nullopt;
};

// All that goes into an image.
struct BakedScene {
  double tool_radius_m = 0.0;
  // How many tools touch the scene, 1 to kMaxTools.
  std::size_t tool_count = 1;
  std::vector<BakedObject> objects;
  // Forces without a surface, which every tool feels.
  std::vector<rendering::Effect> effects;
  // The gravity that acts on bodies, m/s^2; nothing for the earth's, downward.
  std::optional<Vec3> gravity_W = std::nullopt;
  // The effective modulus of soft fingers, Pa; 0 for fingers that touch in a point.
  double soft_finger_modulus_Pa = 0.0;
  // The time for which bodies are at rest before they fall asleep, s; 0: never.
  double sleep_after_s = 0.0;
  // The needle of every tool; nothing for tools without one.
  std::optional<rendering::Needle> needle = std::nullopt;
};

// Returns the bytes that an object's arrays take in the image.
std::uint64_t image_bytes(const BakedMesh& mesh);

// Returns the whole image, ready for SceneImage::open; the same scene gives the same bytes. Throws
// InputError if the scene is larger than the format can be (2 GiB) or has no object or too many.
std::vector<std::byte> write_image(const BakedScene& scene);

}  // namespace tactus::host
