#include "host_tools/bake/scene/detail_description.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <array>

namespace tactus::host {
namespace {

using rendering::TextureProjection;
using rendering::TextureUse;

constexpr std::array kShadingKeys{KeySpec{"angle_limit_deg", "deg"}};
// In the order of rendering::TextureUse.
constexpr std::array kUseKeys{KeySpec{"stiffness", ""}, KeySpec{"friction", ""},
                              KeySpec{"bump", ""}, KeySpec{"normal", ""}};
constexpr std::array kFactorKeys{KeySpec{"image", ""}, KeySpec{"range", ""}, KeySpec{"tile_m", "m"},
                                 KeySpec{"projection", ""}};
constexpr std::array kBumpKeys{KeySpec{"image", ""}, KeySpec{"height_m", "m"},
                               KeySpec{"tile_m", "m"}, KeySpec{"projection", ""}};
constexpr std::array kNormalKeys{KeySpec{"image", ""}, KeySpec{"tile_m", "m"},
                                 KeySpec{"projection", ""}};

// The names of the projections in TOML.
struct NamedProjection {
  std::string_view name;
  TextureProjection projection;
};
constexpr std::array kProjections{
    NamedProjection{"uv", TextureProjection::uv},
    NamedProjection{"x", TextureProjection::x},
    NamedProjection{"y", TextureProjection::y},
    NamedProjection{"z", TextureProjection::z},
    NamedProjection{"triplanar", TextureProjection::triplanar},
};

// Returns the keys that a texture of this use may have.
std::span<const KeySpec> keys_of(TextureUse use) {
  switch (use) {
    case TextureUse::bump:
      return kBumpKeys;
    case TextureUse::normal:
      return kNormalKeys;
    default:
      return kFactorKeys;
  }
}

// Returns the angle between triangles, degrees, above which an edge stays sharp.
double read_angle_limit(const toml::table& table, const TomlSection& object,
                        std::string_view file) {
  constexpr double kStraight_deg = 180.0;
  const TomlSection section(table, file, object.title() + " shading", kShadingKeys);
  const double limit =
      section.number("angle_limit_deg", kAboveZero).value_or(kDefaultAngleLimit_deg);
  if (limit > kStraight_deg) {
    section.fail("angle_limit_deg",
                 fmt::format("angle_limit_deg is {}; write a number up to 180", limit));
  }
  return limit;
}

// Reads how a picture lies on the surface. `tile_m` implies a projection through space, and texture
// coordinates have their own size, so the two exclude each other.
void read_projection(const TomlSection& section, bool is_mesh, TextureDescription& texture) {
  const std::optional<double> tile_m = section.number("tile_m", kAboveZero);
  if (tile_m && (*tile_m < rendering::kLeastTile_m || *tile_m > rendering::kWorldBound_m)) {
    section.fail("tile_m", fmt::format("tile_m is {}; write a number from {} to {}", *tile_m,
                                       rendering::kLeastTile_m, rendering::kWorldBound_m));
  }
  texture.tile_m = tile_m.value_or(kDefaultTile_m);
  if (const std::optional<std::string> name = section.text("projection")) {
    const auto* const found = std::ranges::find(kProjections, *name, &NamedProjection::name);
    if (found == kProjections.end()) {
      section.fail("projection",
                   fmt::format("no projection \"{}\"; write one of \"uv\", \"x\", \"y\", \"z\", "
                               "\"triplanar\"",
                               *name));
    }
    texture.projection = found->projection;
  } else if (tile_m || !is_mesh) {
    texture.projection = TextureProjection::triplanar;
  }
  if (texture.projection != TextureProjection::uv) {
    return;
  }
  if (!is_mesh) {
    section.fail("projection", R"("uv" is for meshes with texture coordinates; write "triplanar")");
  }
  if (tile_m) {
    section.fail("tile_m",
                 "texture coordinates say how large the picture is; leave tile_m out, or write "
                 "projection = \"triplanar\"");
  }
}

// Reads the factors of black and white for stiffness and friction.
void read_range(const TomlSection& section, TextureDescription& texture) {
  if (const auto range = section.numbers("range", 2)) {
    texture.low = (*range)[0];
    texture.high = (*range)[1];
  }
  for (const double factor : {texture.low, texture.high}) {
    if (factor < 0.0 || factor > rendering::kMostTextureFactor) {
      section.fail("range", fmt::format("range holds {}; write the factors of black and of white, "
                                        "each from 0 to {}",
                                        factor, rendering::kMostTextureFactor));
    }
  }
}

// Reads the height of white over black for a bump map.
void read_height(const TomlSection& section, TextureDescription& texture) {
  const std::optional<double> height_m = section.number("height_m", kAboveZero);
  if (!height_m) {
    section.fail("height_m", "the depth of black below white is missing; write height_m = 0.0002");
  }
  if (*height_m > rendering::kMostBump_m) {
    section.fail("height_m", fmt::format("height_m is {}; write a number up to {}", *height_m,
                                         rendering::kMostBump_m));
  }
  texture.high = *height_m;
}

// Reads one [object.texture.*] table. A relative path of the picture begins at `folder`.
TextureDescription read_texture(const TomlSection& section, TextureUse use, bool is_mesh,
                                const std::filesystem::path& folder) {
  TextureDescription texture{.use = use};
  const std::optional<std::string> image = section.text("image");
  if (!image) {
    section.fail("image", "the picture is missing; write image = \"file.png\"");
  }
  texture.image = folder / *image;
  texture.line = section.line("image");
  read_projection(section, is_mesh, texture);
  if (use == TextureUse::bump) {
    read_height(section, texture);
  } else if (use != TextureUse::normal) {
    read_range(section, texture);
  }
  return texture;
}

}  // namespace

DetailDescription read_detail(const TomlSection& object, std::string_view file,
                              const std::filesystem::path& folder, const ShapeDescription& shape,
                              rendering::ContactMethod contact) {
  DetailDescription detail;
  const bool is_mesh = std::holds_alternative<std::monostate>(shape);
  for (const std::string_view key : {"shading", "texture"}) {
    if (!rendering::renders_detail(contact) && object.has(key)) {
      object.fail(key, fmt::format("{} has no {}; leave it out, or leave out contact",
                                   contact == rendering::ContactMethod::potential_field
                                       ? "a potential field"
                                       : "a textbook's method",
                                   key));
    }
  }
  if (const toml::table* shading = object.table("shading")) {
    if (!is_mesh) {
      object.fail("shading", "the normals of primitives and formulas are exact; leave shading out");
    }
    detail.angle_limit_deg = read_angle_limit(*shading, object, file);
  }
  if (const toml::table* textures = object.table("texture")) {
    const TomlSection section(*textures, file, object.title() + " texture", kUseKeys);
    for (std::size_t i = 0; i < kUseKeys.size(); ++i) {
      if (const toml::table* table = section.table(kUseKeys[i].name)) {
        const auto use = static_cast<TextureUse>(i);
        const TomlSection own(*table, file, fmt::format("{} {}", section.title(), kUseKeys[i].name),
                              keys_of(use));
        detail.textures.push_back(read_texture(own, use, is_mesh, folder));
      }
    }
  }
  return detail;
}

}  // namespace tactus::host
