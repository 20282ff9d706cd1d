// Maps a point of a surface to a place on a picture: by the texture coordinates of a triangle, or
// by projection along the axes if the surface has none.
#pragma once

#include <array>
#include <cstddef>

#include "rendering/material/texture.h"

namespace tactus::rendering {

// One place in a picture, and how it moves with the surface point.
struct TextureSpot {
  // The place in the picture.
  TexturePoint at;
  // The gradients of u and v along the surface, 1/m.
  Vec3 grad_u_W = Vec3::Zero();
  Vec3 grad_v_W = Vec3::Zero();
  // The share of the blend.
  double weight = 1.0;
};

// Up to three places whose pictures are blended; the weights sum up to 1.
struct TexturePlace {
  std::array<TextureSpot, 3> spots{};
  std::size_t count = 0;
};

// A triangle with texture coordinates at its corners.
struct TexturedTriangle {
  std::array<Vec3, 3> corners_W;
  std::array<TexturePoint, 3> uv;
};

// Returns the place by barycentric interpolation at the point of the triangle's plane nearest to
// p_W. A triangle without area gives the place of its first corner, and no gradients.
TexturePlace place_on_triangle(const TexturedTriangle& triangle, const Vec3& p_W);

// Returns the place on a picture of tile_m x tile_m, repeated without end and projected along one
// axis (0, 1, 2 for x, y, z) of the frame of p_O and the unit surface normal n_O. The picture is
// upright when seen from the axis's positive end. It is stretched without end on a surface that
// runs along the axis; gradients stay along the surface.
TexturePlace place_along_axis(const Vec3& p_O, const Vec3& n_O, int axis, double tile_m);

// Returns the places of the three pictures along the axes, blended by how squarely the surface
// faces each (the fourth power of the normal's components): there are no seams and no stretched
// parts.
TexturePlace place_triplanar(const Vec3& p_O, const Vec3& n_O, double tile_m);

// The value and the slope of a texture at a place.
struct TextureSample {
  // The colour, each channel from 0 to 1; grey is the same three times.
  Vec3 colour = Vec3::Zero();
  Vec3 slope_W =
      Vec3::Zero();  // 1/m: the gradient of channel 0 along the surface, at constant weights
};

// Returns the sample, filtered for a tool that moves `travel_m` along the surface per tick.
TextureSample look_up(const TextureView& texture, const TexturePlace& place, double travel_m);

// Returns the colour without the slope, at a fifth of the cost.
Vec3 look_up_colour(const TextureView& texture, const TexturePlace& place, double travel_m);

// Returns the unit normal of a surface raised by `height_m` times channel 0, to first order. n_W is
// unit.
Vec3 bumped_normal(const Vec3& n_W, const TextureSample& sample, double height_m);

// Returns the direction that the colour of a normal map stands for, in the frame of the surface:
// red to the right (u), green up (v), blue out. It is unit, and out if the colour stands for no
// direction.
Vec3 mapped_normal(const Vec3& colour);

// Returns the unit normal `n_W` tilted by a normal map at that place. A picture that is drawn out
// without end does not tilt it.
Vec3 mapped_normal(const TextureView& texture, const TexturePlace& place, const Vec3& n_W,
                   double travel_m);

}  // namespace tactus::rendering
