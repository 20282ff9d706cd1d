// The friction models, each in a file of its own, and what follows from the list: a new model is
// one more #include and one more name here.
#pragma once

#include <algorithm>
#include <span>
#include <string_view>

#include "rendering/friction/friction_parameters.h"
#include "rendering/friction/models/coulomb_viscous.h"
#include "rendering/friction/models/dahl.h"
#include "rendering/friction/models/elasto_plastic.h"
#include "rendering/friction/models/friction_cone.h"
#include "rendering/friction/models/karnopp.h"
#include "rendering/friction/models/lugre.h"
#include "rendering/friction/models/stribeck.h"
#include "rendering/type_list.h"

namespace tactus::rendering {

// A model's place is its number in images and recordings: add new ones at the end.
using FrictionModels = TypeList<FrictionConeModel, CoulombViscousModel, StribeckModel, KarnoppModel,
                                DahlModel, LugreModel, ElastoPlasticModel>;

inline constexpr std::size_t kFrictionKinds = FrictionModels::kSize;

template <class Model>
inline constexpr FrictionKind kFrictionKindOf =
    static_cast<FrictionKind>(FrictionModels::number_of<Model>());
static_assert(kFrictionKindOf<FrictionConeModel> == FrictionKind::cone &&
              kFrictionKindOf<CoulombViscousModel> == FrictionKind::coulomb_viscous &&
              kFrictionKindOf<StribeckModel> == FrictionKind::stribeck &&
              kFrictionKindOf<KarnoppModel> == FrictionKind::karnopp &&
              kFrictionKindOf<DahlModel> == FrictionKind::dahl &&
              kFrictionKindOf<LugreModel> == FrictionKind::lugre &&
              kFrictionKindOf<ElastoPlasticModel> == FrictionKind::elasto_plastic);

// The description of a model, as it gives it.
struct FrictionModelTraits {
  FrictionKind kind;
  std::string_view name;   // of --model, and of `model` in TOML
  std::string_view title;  // in a heading
  bool has_bristles;       // it needs a stiffness above 0
  std::span<double FrictionParameters::* const> parameters;

  [[nodiscard]] constexpr bool has(double FrictionParameters::* parameter) const {
    return std::ranges::find(parameters, parameter) != parameters.end();
  }
};

inline constexpr std::array kFrictionModels =
    FrictionModels::map([]<class Model>(std::type_identity<Model> /*model*/) {
      return FrictionModelTraits{.kind = kFrictionKindOf<Model>,
                                 .name = Model::kName,
                                 .title = Model::kTitle,
                                 .has_bristles = Model::kHasBristles,
                                 .parameters = Model::kParameters};
    });

// A set of models: bit 1 << kind for each.
using FrictionKinds = std::uint64_t;
static_assert(kFrictionKinds <= 64);

constexpr bool contains(FrictionKinds kinds, FrictionKind kind) {
  return (kinds >> static_cast<unsigned>(kind) & 1U) != 0;
}

// Returns the models that have a parameter.
constexpr FrictionKinds kinds_with(double FrictionParameters::* parameter) {
  FrictionKinds kinds = 0;
  for (const FrictionModelTraits& model : kFrictionModels) {
    kinds |= FrictionKinds{model.has(parameter)} << static_cast<unsigned>(model.kind);
  }
  return kinds;
}

// Returns true if the model has a static level Fs of its own; the others stick up to Fc.
constexpr bool has_static_level(FrictionKind kind) {
  constexpr FrictionKinds kKinds = kinds_with(&FrictionParameters::static_level);
  return contains(kKinds, kind);
}

// Returns true if the model has the viscous term sigma2.
constexpr bool is_viscous(FrictionKind kind) {
  constexpr FrictionKinds kKinds = kinds_with(&FrictionParameters::viscous_s_per_m);
  return contains(kKinds, kind);
}

// Returns true if the model has the damping sigma1.
constexpr bool is_damped(FrictionKind kind) {
  constexpr FrictionKinds kKinds = kinds_with(&FrictionParameters::damping_s_per_m);
  return contains(kKinds, kind);
}

// Returns true if the model yields while it sticks, and so needs a stiffness above 0.
constexpr bool has_bristles(FrictionKind kind) {
  constexpr FrictionKinds kKinds = [] {
    FrictionKinds kinds = 0;
    for (const FrictionModelTraits& model : kFrictionModels) {
      kinds |= FrictionKinds{model.has_bristles} << static_cast<unsigned>(model.kind);
    }
    return kinds;
  }();
  return contains(kKinds, kind);
}

}  // namespace tactus::rendering
