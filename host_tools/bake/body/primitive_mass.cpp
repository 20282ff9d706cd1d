#include "host_tools/bake/body/primitive_mass.h"

#include <fmt/format.h>

#include <numbers>
#include <optional>

#include "host_tools/input_error.h"
#include "rendering/limits.h"

namespace tactus::host {
namespace {

using rendering::Primitive;
using rendering::PrimitiveDimensions;
using rendering::PrimitiveKind;

// The properties of a solid of density 1. All are symmetric about the axes of O through a centre on
// the y axis.
struct UnitSolid {
  double volume;
  // The moments about the axes through the centre, over the mass.
  Vec3 square_radii;
  double center_y = 0.0;
};

// Returns the square radii of a solid of revolution about y.
Vec3 of_revolution(double about_y, double across) {
  return {across, about_y, across};
}

UnitSolid sphere(double r) {
  return {4.0 / 3.0 * std::numbers::pi * r * r * r, Vec3::Constant(0.4 * r * r)};
}

UnitSolid box(const Vec3& half) {
  const Vec3 squares = half.cwiseAbs2() / 3.0;
  return {8.0 * half.prod(), Vec3::Constant(squares.sum()) - squares};
}

UnitSolid cylinder(double r, double half_height) {
  return {2.0 * std::numbers::pi * r * r * half_height,
          of_revolution(r * r / 2.0, r * r / 4.0 + half_height * half_height / 3.0)};
}

// A cylinder and the halves of a sphere, whose centres of mass lie 3/8 r beyond its ends.
UnitSolid capsule(double r, double half_height) {
  const UnitSolid middle = cylinder(r, half_height);
  const UnitSolid caps = sphere(r);
  const double volume = middle.volume + caps.volume;
  const double moved = half_height * half_height + 0.75 * half_height * r;
  const Vec3 moments = middle.volume * middle.square_radii +
                       caps.volume * (caps.square_radii + of_revolution(0.0, moved));
  return {volume, moments / volume};
}

UnitSolid cone(double r, double height) {
  return {std::numbers::pi * r * r * height / 3.0,
          of_revolution(0.3 * r * r, 0.15 * r * r + 3.0 / 80.0 * height * height), height / 4.0};
}

UnitSolid torus(double ring, double tube) {
  const double ring2 = ring * ring;
  const double tube2 = tube * tube;
  return {2.0 * std::numbers::pi * std::numbers::pi * ring * tube2,
          of_revolution(ring2 + 0.75 * tube2, ring2 / 2.0 + 0.625 * tube2)};
}

// Returns nothing for a primitive that has no closed form here.
std::optional<UnitSolid> unit_solid(const Primitive& primitive) {
  const PrimitiveDimensions& d = primitive.dimensions_m;
  switch (primitive.kind) {
    case PrimitiveKind::sphere:
      return sphere(d[0]);
    case PrimitiveKind::box:
      return box({d[0], d[1], d[2]});
    case PrimitiveKind::cylinder:
      return cylinder(d[0], d[1]);
    case PrimitiveKind::capsule:
      return capsule(d[0], d[1]);
    case PrimitiveKind::cone:
      return cone(d[0], d[1]);
    case PrimitiveKind::torus:
      return torus(d[0], d[1]);
    case PrimitiveKind::plane:
    default:
      return std::nullopt;
  }
}

const rendering::PrimitiveTraits& traits_of(const Primitive& primitive) {
  return rendering::kPrimitives[static_cast<std::size_t>(primitive.kind)];
}

// Throws InputError unless the dimensions are those of a solid.
void require_dimensions(const Primitive& primitive) {
  if (rendering::valid({.kind = primitive.kind, .dimensions_m = primitive.dimensions_m})) {
    return;
  }
  const rendering::PrimitiveTraits& traits = traits_of(primitive);
  throw InputError(
      fmt::format("a dimension of the {} is wrong: each must be above 0 and at most {} m{}{}; "
                  "correct it",
                  traits.name, rendering::kWorldBound_m, traits.condition.empty() ? "" : ", and ",
                  traits.condition));
}

}  // namespace

MassProperties primitive_mass_properties(const Primitive& primitive, double density_kg_per_m3) {
  require_density(density_kg_per_m3);
  if (primitive.kind == PrimitiveKind::plane) {
    throw InputError(
        "a plane has no end, and so no mass: it cannot be a body; leave it at rest, or take a box");
  }
  require_dimensions(primitive);
  const std::optional<UnitSolid> solid = unit_solid(primitive);
  if (!solid) {
    throw InputError(fmt::format(
        "the mass of a {} is not known, since it has no formula in primitive_mass.cpp; take a mesh",
        traits_of(primitive).name));
  }
  const double mass = density_kg_per_m3 * solid->volume;
  return {.mass_kg = mass,
          .center_O = {0.0, solid->center_y, 0.0},
          .inertia_C = (mass * solid->square_radii).asDiagonal()};
}

}  // namespace tactus::host
