// Primitives by another way than the code under test takes: their surfaces as patches that are
// walked point by point, and their insides as inequalities.
#pragma once

#include <functional>
#include <random>
#include <vector>

#include "rendering/surface/primitive.h"

namespace tactus::testing {

// (u, v) in [0, 1] x [0, 1] to a surface point, world frame, metres.
using Patch = std::function<Vec3(double, double)>;

// Together they are the primitive's surface; of a plane, the square of one metre about its origin.
std::vector<Patch> patches(const rendering::Primitive& primitive);

// The distance from q to the patches by search from many starts; exact to about 1e-9 m for patches
// of some centimetres.
double searched_distance(const std::vector<Patch>& surface, const Vec3& q);

bool inside(const rendering::Primitive& primitive, const Vec3& q_W);

// A random pose and dimensions between 5 and 50 mm.
rendering::Primitive random_primitive(rendering::PrimitiveKind kind, std::mt19937_64& random);

inline constexpr std::array kAllPrimitives{
    rendering::PrimitiveKind::plane,   rendering::PrimitiveKind::sphere,
    rendering::PrimitiveKind::box,     rendering::PrimitiveKind::cylinder,
    rendering::PrimitiveKind::capsule, rendering::PrimitiveKind::cone,
    rendering::PrimitiveKind::torus};

}  // namespace tactus::testing
