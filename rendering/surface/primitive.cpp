#include "rendering/surface/primitive.h"

#include <algorithm>
#include <span>

#include "rendering/limits.h"

namespace tactus::rendering {
namespace {

// Calls `visitor` with std::type_identity of the primitive's struct in primitives/.
template <class Visitor>
auto on_solid(const Primitive& primitive, const Visitor& visitor) {
  return visit_number(Primitives{}, static_cast<std::size_t>(primitive.kind), visitor);
}

}  // namespace

bool valid(const Primitive& primitive) {
  constexpr double kOrthonormal = 1e-9;
  const Mat3& rotation = primitive.X_WO.rotation;
  if (!rotation.allFinite() || !primitive.X_WO.translation.allFinite() ||
      static_cast<std::size_t>(primitive.kind) >= kPrimitiveKinds) {
    return false;
  }
  const double skew = (rotation.transpose() * rotation - Mat3::Identity()).cwiseAbs().maxCoeff();
  if (skew > kOrthonormal || rotation.determinant() < 0.0) {
    return false;
  }
  const std::size_t count = kPrimitives[static_cast<std::size_t>(primitive.kind)].dimension_count();
  for (std::size_t k = 0; k < count; ++k) {
    const double length = primitive.dimensions_m[k];
    const bool named_well = length > 0.0 && length <= kWorldBound_m;  // false for NaN
    if (!named_well) {
      return false;
    }
  }
  return on_solid(primitive, [&]<class Solid>(std::type_identity<Solid> /*solid*/) {
    if constexpr (requires { Solid::fits(primitive.dimensions_m); }) {
      return Solid::fits(primitive.dimensions_m);
    } else {
      return true;
    }
  });
}

SurfaceSample sample(const Primitive& primitive, const Vec3& p_W) {
  const Vec3 p_O = primitive.X_WO.point_in(p_W);
  const Measure seen = on_solid(primitive, [&]<class Solid>(std::type_identity<Solid> /*solid*/) {
    return Solid::measure(p_O, primitive.dimensions_m);
  });
  return {.distance_m = seen.distance_m, .normal_W = primitive.X_WO.direction(seen.normal_O)};
}

SurfaceSamples all_contacts(const Primitive& primitive, const Vec3& p_W) {
  const Vec3 p_O = primitive.X_WO.point_in(p_W);
  Contacts contacts;
  on_solid(primitive, [&]<class Solid>(std::type_identity<Solid> /*solid*/) {
    if constexpr (requires { Solid::add_contacts(p_O, primitive.dimensions_m, contacts); }) {
      Solid::add_contacts(p_O, primitive.dimensions_m, contacts);
    }
  });
  SurfaceSamples found{.round_count = contacts.round_count()};
  for (const Measure& contact : contacts.all()) {
    found.samples[found.count++] = {.distance_m = contact.distance_m,
                                    .normal_W = primitive.X_WO.direction(contact.normal_O)};
  }
  return found;
}

// On an edge the normal is that of none of the walls that meet there.
bool is_nearest_on_edge(const Primitive& primitive, const SurfaceSample& seen, const Vec3& p_W) {
  if (!convex(primitive) || !(seen.distance_m > 0.0)) {
    return false;
  }
  constexpr double kSameDirection = 1.0 - 1e-9;
  const SurfaceSamples walls = all_contacts(primitive, p_W);
  return walls.count > 0 &&
         std::ranges::none_of(std::span(walls.samples).first(walls.count),
                              [&](const SurfaceSample& wall) {
                                return wall.normal_W.dot(seen.normal_W) > kSameDirection;
                              });
}

Bounds bounds(const Primitive& primitive) {
  return on_solid(primitive, [&]<class Solid>(std::type_identity<Solid> /*solid*/) {
    return Solid::extent(primitive.X_WO, primitive.dimensions_m);
  });
}

}  // namespace tactus::rendering
