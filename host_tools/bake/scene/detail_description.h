// The part of an [[object]] that says what its surface has beyond shape and material.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "host_tools/bake/scene/shape_description.h"
#include "host_tools/bake/toml/toml_section.h"
#include "rendering/material/surface_detail.h"

namespace tactus::host {

struct TextureDescription {
  rendering::TextureUse use = rendering::TextureUse::stiffness;
  std::filesystem::path image;  // resolved against the scene file's folder
  std::size_t line = 0;         // of the texture, for errors in it
  // Not given: the mesh's texture coordinates, and triplanar where there are none.
  std::optional<rendering::TextureProjection> projection;
  double tile_m = 0.0;
  double low = 0.0;  // see rendering::TextureUse
  double high = 1.0;
};

struct DetailDescription {
  std::optional<double> angle_limit_deg;  // of a mesh that is shaded
  std::vector<TextureDescription> textures;
};

inline constexpr double kDefaultAngleLimit_deg = 40.0;
inline constexpr double kDefaultTile_m = 0.01;

// The keys `shading` and `texture` of an object of that shape and contact method. Throws
// InputError. Image files are not opened.
DetailDescription read_detail(const TomlSection& object, std::string_view file,
                              const std::filesystem::path& folder, const ShapeDescription& shape,
                              rendering::ContactMethod contact);

}  // namespace tactus::host
