// Optional detail of a surface: normals interpolated between the corners of its triangles, and
// textures. An object carries it (rendering/objects/object.h), and the world asks detail_at() for
// it at every contact.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "rendering/geometry/vector.h"
#include "rendering/material/octahedral.h"
#include "rendering/material/texture_place.h"
#include "rendering/surface/connected_mesh.h"

namespace tactus::rendering {

// The use of a picture.
enum class TextureUse : std::uint8_t {
  stiffness = 0,  // grey: multiplies K by low (black) to high (white)
  friction = 1,   // grey: multiplies both coefficients by low to high
  bump = 2,       // grey: white is the surface, black lies `high` metres below it
  normal = 3,     // RGB: the normal, red along u, green along v, blue outward
};
inline constexpr std::size_t kTextureUses = 4;

// The projection of a picture on the surface: by the mesh's texture coordinates, or along axes of
// the object frame O in squares of `tile_m`.
enum class TextureProjection : std::uint8_t { uv = 0, x = 1, y = 2, z = 3, triplanar = 4 };

// One texture, the layout of the baked image.
struct TextureLayer {
  // The property that the picture changes, and the projection of the picture on the surface.
  TextureUse use = TextureUse::stiffness;
  TextureProjection projection = TextureProjection::triplanar;
  TextureFormat format = TextureFormat::grey;
  std::uint8_t unused = 0;
  std::uint32_t width = 1;
  std::uint32_t height = 1;
  // The first byte of its pyramid, in SurfaceDetail::texels.
  std::uint32_t first_byte = 0;
  // The side of the square that the picture fills, m; not used with uv.
  double tile_m = 1.0;
  // The range of the use: factors of K or friction, or the depth of black, m, in `high`.
  double low = 0.0;
  double high = 1.0;
};
static_assert(sizeof(TextureLayer) == 40);

using CornerNormals = std::array<OctahedralNormal, 3>;
using CornerPlaces = std::array<std::array<float, 2>, 3>;  // u and v
static_assert(sizeof(CornerNormals) == 12 && sizeof(CornerPlaces) == 24);

// Views of memory that the caller keeps alive and unchanged. The default is no detail.
struct SurfaceDetail {
  // The unit normals at each triangle's corners, object frame; none if the surface is not shaded.
  std::span<const CornerNormals> corner_normals;
  // The texture coordinates at each triangle's corners; none without uv.
  std::span<const CornerPlaces> corner_places;
  // The textures, at most one of each use.
  std::span<const TextureLayer> layers;
  // The pictures of all layers, each with its coarser levels (texture.h).
  std::span<const std::uint8_t> texels;

  // Returns true if there is no detail.
  [[nodiscard]] bool empty() const { return corner_normals.empty() && layers.empty(); }
};

// A factor above this, a bump deeper than this, or a tile smaller than this is taken for an error.
inline constexpr double kMostTextureFactor = 100.0;
inline constexpr double kMostBump_m = 0.1;
inline constexpr double kLeastTile_m = 1e-5;
// Bytes of all the textures of an object, for baking.
inline constexpr std::size_t kMostTexels = std::size_t{1} << 30U;
// Texture coordinates lie between plus and minus this.
inline constexpr float kMostTexturePlace = 1048576.0F;

// The faults that check() finds in a detail.
enum class DetailFault : std::uint8_t {
  none,
  normals,  // as many corner normals as triangles, or none
  places,   // as many corner places as triangles, or none; finite, at most kMostTexturePlace
  layer,    // one a use; sizes, bytes, format and projection that are there; numbers in range
};

// The first fault of a detail, and its place.
struct DetailCheck {
  DetailFault fault = DetailFault::none;
  // The number of the triangle or layer at fault; for wrong counts the number found.
  std::size_t place = 0;
};

// Checks the detail of a surface with so many triangles; 0 for a surface that is no mesh. The time
// grows with the mesh.
DetailCheck check(const SurfaceDetail& detail, std::size_t triangles);

// The point at which the tool touches the surface, in the object frame.
struct SurfaceContact {
  // The triangle of a mesh, and the feature of it that is touched.
  std::uint32_t triangle = 0;
  Feature feature = Feature::face;  // of that triangle
  // The number of the edge, for Feature::edge.
  std::uint8_t edge = 0;
  // The point of the surface, m.
  Vec3 point_O = Vec3::Zero();
  // The unit vector from there to the tool.
  Vec3 normal_O = Vec3::UnitY();
  // The travel of the point since the last tick, m, for the choice of the texture's level.
  double travel_m = 0.0;
};

// The detail at a contact.
struct Detail {
  // The unit normal: interpolated, then tilted by the textures.
  Vec3 normal_O = Vec3::UnitY();
  // The factors of K and of both friction coefficients.
  double stiffness_factor = 1.0;
  double friction_factor = 1.0;
  // The height of the bump's surface over the geometry's, m, <= 0.
  double height_m = 0.0;
};

// Returns the detail at a contact. `mesh` is empty for a surface that is no mesh; without
// neighbours, edges are shaded like their triangle. `detail` must have passed check(). Real time:
// no heap; 0.1 us without textures, and 0.5 to 0.9 us for each of them.
Detail detail_at(const SurfaceDetail& detail, const ConnectedMesh& mesh,
                 const SurfaceContact& contact);

}  // namespace tactus::rendering
