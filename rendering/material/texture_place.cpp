#include "rendering/material/texture_place.h"

#include <algorithm>
#include <cmath>

#include "rendering/geometry/tangential.h"

namespace tactus::rendering {
namespace {

// Returns the size on the surface of a texel along a direction in which u (or v) grows by
// `gradient` a metre.
double texel_size(const Vec3& gradient, std::uint32_t texels) {
  return 1.0 / (gradient.norm() * texels);
}

// Returns the level for a tool at this speed. The smaller side of the texel decides, so that
// neither direction aliases.
double level_for(const TextureView& texture, const TextureSpot& spot, double travel_m) {
  const double texel_m = std::min(texel_size(spot.grad_u_W, texture.size().width),
                                  texel_size(spot.grad_v_W, texture.size().height));
  return mip_level(texture, travel_m, texel_m);
}

// u and v axes of the picture seen from the positive end of each axis: v is up, u to the right.
constexpr std::array<std::array<Eigen::Index, 2>, 3> kPictureAxes{{{2, 1}, {0, 2}, {0, 1}}};
constexpr std::array<std::array<double, 2>, 3> kPictureSigns{{{-1, 1}, {1, -1}, {1, 1}}};

// Returns the place of p on the picture that shines along one axis, with the gradients along the
// surface.
TextureSpot shine(const Vec3& p, const Vec3& n, std::size_t axis, double tile_m) {
  const auto& [u_axis, v_axis] = kPictureAxes[axis];
  const auto& [u_sign, v_sign] = kPictureSigns[axis];
  const Vec3 u = u_sign / tile_m * Vec3::Unit(u_axis);
  const Vec3 v = v_sign / tile_m * Vec3::Unit(v_axis);
  return {.at = {.u = u.dot(p), .v = v.dot(p)},
          .grad_u_W = tangential(u, n),
          .grad_v_W = tangential(v, n)};
}

}  // namespace

TexturePlace place_on_triangle(const TexturedTriangle& triangle, const Vec3& p_W) {
  const auto& [a, b, c] = triangle.corners_W;
  const auto& [at_a, at_b, at_c] = triangle.uv;
  const Vec3 along = b - a;
  const Vec3 across = c - a;
  const Vec3 normal = along.cross(across);
  const double squared = normal.squaredNorm();
  TexturePlace place{.count = 1};
  place.spots[0].at = at_a;
  if (!(squared > 0.0)) {
    return place;
  }
  // The gradients of the weights of b and c.
  const Vec3 grad_b = across.cross(normal) / squared;
  const Vec3 grad_c = normal.cross(along) / squared;
  TextureSpot& spot = place.spots[0];
  spot.grad_u_W = (at_b.u - at_a.u) * grad_b + (at_c.u - at_a.u) * grad_c;
  spot.grad_v_W = (at_b.v - at_a.v) * grad_b + (at_c.v - at_a.v) * grad_c;
  spot.at.u += spot.grad_u_W.dot(p_W - a);
  spot.at.v += spot.grad_v_W.dot(p_W - a);
  return place;
}

TexturePlace place_along_axis(const Vec3& p_O, const Vec3& n_O, int axis, double tile_m) {
  TexturePlace place{.count = 1};
  place.spots[0] = shine(p_O, n_O, static_cast<std::size_t>(axis), tile_m);
  return place;
}

TexturePlace place_triplanar(const Vec3& p_O, const Vec3& n_O, double tile_m) {
  // The fourth power of the normal's components; the weights sum up to 1.
  const Vec3 facing = n_O.cwiseAbs2().cwiseAbs2();
  const double sum = facing.sum();
  TexturePlace place{.count = 3};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    place.spots[axis] = shine(p_O, n_O, axis, tile_m);
    place.spots[axis].weight = facing[static_cast<Eigen::Index>(axis)] / sum;
  }
  return place;
}

TextureSample look_up(const TextureView& texture, const TexturePlace& place, double travel_m) {
  TextureSample sample;
  for (std::size_t i = 0; i < place.count; ++i) {
    const TextureSpot& spot = place.spots[i];
    const double level = level_for(texture, spot, travel_m);
    const TextureSlope rise = slope(texture, spot.at, level);
    sample.colour += spot.weight * look_up(texture, spot.at, level);
    sample.slope_W += spot.weight * (rise.per_u * spot.grad_u_W + rise.per_v * spot.grad_v_W);
  }
  return sample;
}

Vec3 look_up_colour(const TextureView& texture, const TexturePlace& place, double travel_m) {
  Vec3 colour = Vec3::Zero();
  for (std::size_t i = 0; i < place.count; ++i) {
    const TextureSpot& spot = place.spots[i];
    colour += spot.weight * look_up(texture, spot.at, level_for(texture, spot, travel_m));
  }
  return colour;
}

// The gradient of the raised surface leans the normal against the slope (Blinn, "Simulation of
// wrinkled surfaces", SIGGRAPH 1978).
Vec3 bumped_normal(const Vec3& n_W, const TextureSample& sample, double height_m) {
  const Vec3 along = sample.slope_W - sample.slope_W.dot(n_W) * n_W;
  return (n_W - height_m * along).normalized();
}

Vec3 mapped_normal(const Vec3& colour) {
  const Vec3 n = 2.0 * colour - Vec3::Ones();
  const double length = n.norm();
  return length > 0.0 ? Vec3{n / length} : Vec3::UnitZ();
}

Vec3 mapped_normal(const TextureView& texture, const TexturePlace& place, const Vec3& n_W,
                   double travel_m) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < place.count; ++i) {
    const TextureSpot& spot = place.spots[i];
    const Vec3 right = spot.grad_u_W - spot.grad_u_W.dot(n_W) * n_W;
    const double length = right.norm();
    if (!(length > 0.0)) {
      sum += spot.weight * n_W;
      continue;
    }
    // A mirrored picture has its up side down.
    const Vec3 across = n_W.cross(right) / length;
    const double up = across.dot(spot.grad_v_W) < 0.0 ? -1.0 : 1.0;
    const Vec3 n = mapped_normal(look_up(texture, spot.at, level_for(texture, spot, travel_m)));
    sum += spot.weight * (n.x() / length * right + up * n.y() * across + n.z() * n_W);
  }
  const double length = sum.norm();
  return length > 0.0 ? Vec3{sum / length} : n_W;
}

}  // namespace tactus::rendering
