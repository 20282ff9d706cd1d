#include "rendering/material/surface_detail.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "rendering/material/shading_normal.h"

namespace tactus::rendering {
namespace {

// Returns the layer's picture, or nothing if its numbers do not fit the bytes.
std::optional<TextureView> view_of(const TextureLayer& layer,
                                   std::span<const std::uint8_t> texels) {
  const TextureSize size{layer.width, layer.height};
  const bool known = layer.format == TextureFormat::grey || layer.format == TextureFormat::rgb;
  if (!known || std::min(size.width, size.height) == 0 ||
      std::max(size.width, size.height) > kMaxTextureSide) {
    return std::nullopt;
  }
  const std::size_t bytes = pyramid_bytes(size, layer.format);
  if (layer.first_byte > texels.size() || bytes > texels.size() - layer.first_byte) {
    return std::nullopt;
  }
  return TextureView::open(texels.subspan(layer.first_byte, bytes), size, layer.format);
}

bool in_range(double value, double lowest, double highest) {
  return value >= lowest && value <= highest;  // false for NaN
}

// Returns true if the range of the layer's use is sound.
bool numbers_in_range(const TextureLayer& layer) {
  switch (layer.use) {
    case TextureUse::stiffness:
    case TextureUse::friction:
      return in_range(layer.low, 0.0, kMostTextureFactor) &&
             in_range(layer.high, 0.0, kMostTextureFactor);
    case TextureUse::bump:
      return in_range(layer.high, 0.0, kMostBump_m);
    default:
      return true;
  }
}

// Returns true if every number and byte that detail_at() reads of the layer is there and in range.
bool sound(const TextureLayer& layer, const SurfaceDetail& detail) {
  const bool wants_colour = layer.use == TextureUse::normal;
  const bool known = layer.use <= TextureUse::normal &&
                     layer.projection <= TextureProjection::triplanar &&
                     (layer.format == TextureFormat::rgb) == wants_colour;
  const bool placed = layer.projection == TextureProjection::uv
                          ? !detail.corner_places.empty()
                          : in_range(layer.tile_m, kLeastTile_m, kWorldBound_m);
  return known && placed && numbers_in_range(layer) && view_of(layer, detail.texels).has_value();
}

// Returns true if the texture coordinates are in range; NaN is not.
bool sound(const CornerPlaces& places) {
  return std::ranges::all_of(places, [](const std::array<float, 2>& uv) {
    return std::abs(uv[0]) <= kMostTexturePlace && std::abs(uv[1]) <= kMostTexturePlace;
  });
}

// Returns a triangle of the mesh with its texture coordinates; object frame.
TexturedTriangle textured(const CornerPlaces& places, const MeshView& mesh, std::uint32_t number) {
  TexturedTriangle triangle;
  for (std::size_t k = 0; k < triangle.uv.size(); ++k) {
    triangle.corners_W[k] = to_vec3(mesh.vertices[mesh.triangles[number][k]]);
    triangle.uv[k] = {.u = static_cast<double>(places[k][0]),
                      .v = static_cast<double>(places[k][1])};
  }
  return triangle;
}

// Returns the place of the contact on the layer's picture.
TexturePlace place_of(const TextureLayer& layer, const SurfaceDetail& detail, const MeshView& mesh,
                      const SurfaceContact& contact) {
  switch (layer.projection) {
    case TextureProjection::uv:
      return place_on_triangle(
          textured(detail.corner_places[contact.triangle], mesh, contact.triangle),
          contact.point_O);
    case TextureProjection::triplanar:
      return place_triplanar(contact.point_O, contact.normal_O, layer.tile_m);
    default:
      return place_along_axis(contact.point_O, contact.normal_O,
                              static_cast<int>(layer.projection) - 1, layer.tile_m);
  }
}

// Returns the value of a grey from black, `low`, to white, `high`.
double between(const TextureLayer& layer, double grey) {
  return layer.low + grey * (layer.high - layer.low);
}

}  // namespace

DetailCheck check(const SurfaceDetail& detail, std::size_t triangles) {
  if (!detail.corner_normals.empty() && detail.corner_normals.size() != triangles) {
    return {DetailFault::normals, detail.corner_normals.size()};
  }
  if (!detail.corner_places.empty() && detail.corner_places.size() != triangles) {
    return {DetailFault::places, detail.corner_places.size()};
  }
  for (std::size_t i = 0; i < detail.corner_places.size(); ++i) {
    if (!sound(detail.corner_places[i])) {
      return {DetailFault::places, i};
    }
  }
  std::array<bool, kTextureUses> seen{};
  for (std::size_t i = 0; i < detail.layers.size(); ++i) {
    const TextureLayer& layer = detail.layers[i];
    if (!sound(layer, detail) || seen[static_cast<std::size_t>(layer.use)]) {
      return {DetailFault::layer, i};
    }
    seen[static_cast<std::size_t>(layer.use)] = true;
  }
  return {};
}

Detail detail_at(const SurfaceDetail& detail, const ConnectedMesh& mesh,
                 const SurfaceContact& contact) {
  Detail felt{.normal_O = contact.normal_O};
  if (!detail.corner_normals.empty()) {
    felt.normal_O = shading_normal(detail.corner_normals, mesh, contact);
  }
  // Layers are applied in their order: a bump after a normal map tilts the mapped normal.
  for (const TextureLayer& layer : detail.layers) {
    const std::optional<TextureView> texture = view_of(layer, detail.texels);
    if (!texture) {
      continue;
    }
    const TexturePlace place = place_of(layer, detail, mesh.mesh, contact);
    if (layer.use == TextureUse::normal) {
      felt.normal_O = mapped_normal(*texture, place, felt.normal_O, contact.travel_m);
      continue;
    }
    if (layer.use == TextureUse::bump) {
      const TextureSample seen = look_up(*texture, place, contact.travel_m);
      felt.height_m = (seen.colour.x() - 1.0) * layer.high;
      felt.normal_O = bumped_normal(felt.normal_O, seen, layer.high);
      continue;
    }
    const double factor = between(layer, look_up_colour(*texture, place, contact.travel_m).x());
    (layer.use == TextureUse::stiffness ? felt.stiffness_factor : felt.friction_factor) = factor;
  }
  return felt;
}

}  // namespace tactus::rendering
