// Reads the part of an [[object]] that gives its surface more than shape and material: the keys
// `shading` and `texture`. Part of reading scene.toml; image files are opened later, by
// texture_bake.h.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "host_tools/bake/scene/shape_description.h"
#include "host_tools/bake/toml/toml_section.h"
#include "rendering/material/surface_detail.h"

namespace tactus::host {

// One picture on a surface, as the scene describes it.
struct TextureDescription {
  // The property that the picture changes: stiffness, friction, height (bump) or normal.
  rendering::TextureUse use = rendering::TextureUse::stiffness;
  // The picture's file, resolved against the scene file's folder.
  std::filesystem::path image;
  // The line of the scene that names the picture, for errors in it.
  std::size_t line = 0;
  // How the picture lies on the surface. Not given: by the mesh's texture coordinates, or triplanar
  // if it has none.
  std::optional<rendering::TextureProjection> projection;
  // The size of one repetition of the picture.
  double tile_m = 0.0;
  // The values of black and of white; rendering::TextureUse says what they are for each use.
  double low = 0.0;
  double high = 1.0;
};

// Shading and textures of one object.
struct DetailDescription {
  // The angle above which an edge stays sharp; empty if the object is not shaded.
  std::optional<double> angle_limit_deg;
  // At most one for each use.
  std::vector<TextureDescription> textures;
};

// The values for keys that the scene leaves out.
inline constexpr double kDefaultAngleLimit_deg = 40.0;
inline constexpr double kDefaultTile_m = 0.01;

// Reads the keys `shading` and `texture` of an object with the given shape and contact method;
// paths start from `folder`. Throws InputError with the file and the line.
DetailDescription read_detail(const TomlSection& object, std::string_view file,
                              const std::filesystem::path& folder, const ShapeDescription& shape,
                              rendering::ContactMethod contact);

}  // namespace tactus::host
