// The primitives, each in a file of its own, and what follows from the list: a new primitive is one
// more #include and one more name here.
#pragma once

#include <algorithm>

#include "rendering/surface/primitives/box.h"
#include "rendering/surface/primitives/capsule.h"
#include "rendering/surface/primitives/cone.h"
#include "rendering/surface/primitives/cylinder.h"
#include "rendering/surface/primitives/plane.h"
#include "rendering/surface/primitives/sphere.h"
#include "rendering/surface/primitives/torus.h"
#include "rendering/type_list.h"

namespace tactus::rendering {

// A primitive's place is its number in images: add new ones at the end.
using Primitives =
    TypeList<PlaneSolid, SphereSolid, BoxSolid, CylinderSolid, CapsuleSolid, ConeSolid, TorusSolid>;

inline constexpr std::size_t kPrimitiveKinds = Primitives::kSize;

template <class Solid>
inline constexpr PrimitiveKind kPrimitiveKindOf =
    static_cast<PrimitiveKind>(Primitives::number_of<Solid>());
static_assert(kPrimitiveKindOf<PlaneSolid> == PrimitiveKind::plane &&
              kPrimitiveKindOf<SphereSolid> == PrimitiveKind::sphere &&
              kPrimitiveKindOf<BoxSolid> == PrimitiveKind::box &&
              kPrimitiveKindOf<CylinderSolid> == PrimitiveKind::cylinder &&
              kPrimitiveKindOf<CapsuleSolid> == PrimitiveKind::capsule &&
              kPrimitiveKindOf<ConeSolid> == PrimitiveKind::cone &&
              kPrimitiveKindOf<TorusSolid> == PrimitiveKind::torus);

// The description of a primitive, as it gives it.
struct PrimitiveTraits {
  PrimitiveKind kind;
  std::string_view name;
  std::span<const DimensionKey> dimensions;
  bool is_convex;
  std::string_view condition;  // on its dimensions, in words; empty if positive ones are enough

  // Returns how many of Primitive::dimensions_m it uses.
  [[nodiscard]] constexpr std::size_t dimension_count() const {
    std::size_t count = 0;
    for (const DimensionKey& key : dimensions) {
      count += key.count;
    }
    return count;
  }
};

inline constexpr std::array kPrimitives =
    Primitives::map([]<class Solid>(std::type_identity<Solid> /*solid*/) {
      PrimitiveTraits traits{.kind = kPrimitiveKindOf<Solid>,
                             .name = Solid::kName,
                             .dimensions = Solid::kDimensions,
                             .is_convex = Solid::kIsConvex,
                             .condition = {}};
      if constexpr (requires { Solid::kCondition; }) {
        traits.condition = Solid::kCondition;
      }
      return traits;
    });

// The move of a sphere against a solid that is not convex needs a bound of how its distance bends.
static_assert(
    std::ranges::all_of(kPrimitives,
                        [](const PrimitiveTraits& primitive) {
                          return primitive.is_convex || primitive.kind == PrimitiveKind::torus;
                        }),
    "contact/primitive_sweep.cpp moves a sphere against convex solids and the torus: teach "
    "it the new solid");

}  // namespace tactus::rendering
