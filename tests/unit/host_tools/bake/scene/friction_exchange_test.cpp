// A material whose friction model is exchanged is the one that a scene with the other model gives.
#include "rendering/material/friction_exchange.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "host_tools/bake/scene/friction_description.h"
#include "host_tools/bake/scene/scene_description.h"
#include "rendering/friction/registered_models.h"

namespace tactus::host {
namespace {

using rendering::FrictionKind;
using rendering::FrictionModelTraits;
using rendering::FrictionParameters;
using rendering::Material;

Material rubbed_material(const std::string& friction) {
  return parse_scene_description(
             "[[object]]\nprimitive = \"sphere\"\nradius_m = 0.02\n"
             "stiffness_N_per_m = 700\n" +
                 friction,
             "scene.toml")
      .objects[0]
      .material;
}

// A number that is good for every key, and another one for each but the levels.
double number_for_key(const FrictionParameterName& name) {
  if (name.member == &FrictionParameters::coulomb) {
    return 0.4;
  }
  if (name.member == &FrictionParameters::static_level) {
    return 0.6;
  }
  return 0.1 + 0.01 * static_cast<double>(std::string_view(name.surface_key).size());
}

bool has_key_of(FrictionKind kind, const FrictionParameterName& of) {
  return std::ranges::any_of(surface_parameters(kind), [&](const FrictionParameterName& name) {
    return name.member == of.member;
  });
}

// The text of a model with the keys that the model `from` has too; the others are left out.
std::string friction_keys_of(FrictionKind kind, FrictionKind from) {
  std::string text = fmt::format("friction = {{ model = \"{}\"", model_of(kind).name);
  for (const FrictionParameterName& name : surface_parameters(kind)) {
    if (has_key_of(from, name)) {
      text += fmt::format(", {} = {}", name.surface_key, number_for_key(name));
    } else if (name.member == &FrictionParameters::static_level) {
      text += ", static = 0.4";
    }
  }
  return text + " }\n";
}

void expect_same_friction(const Material& a, const Material& b) {
  EXPECT_EQ(a.stiffness_N_per_m, b.stiffness_N_per_m);
  const FrictionParameters& f = a.friction;
  const FrictionParameters& g = b.friction;
  EXPECT_EQ(f.kind, g.kind);
  for (const FrictionParameterName& name : friction_parameter_names()) {
    EXPECT_EQ(f.*name.member, g.*name.member) << name.surface_key;
  }
}

TEST(FrictionExchange, GivesWhatTheScenesKeysGiveForEveryPairOfModels) {
  for (const FrictionModelTraits& from : rendering::kFrictionModels) {
    const Material baked = rubbed_material(friction_keys_of(from.kind, from.kind));
    for (const FrictionModelTraits& to : rendering::kFrictionModels) {
      SCOPED_TRACE(fmt::format("from {} to {}", from.name, to.name));
      const Material other = with_friction_model(baked, baked, to.kind);
      expect_same_friction(other, rubbed_material(friction_keys_of(to.kind, from.kind)));
      expect_same_friction(with_friction_model(other, baked, from.kind), baked);
    }
  }
}

TEST(FrictionExchange, OfASmoothSurfaceHasTheDefaultsOfTheKeys) {
  const Material smooth = rubbed_material("");
  for (const FrictionModelTraits& to : rendering::kFrictionModels) {
    SCOPED_TRACE(to.name);
    Material wanted = rubbed_material(fmt::format(
        "friction = {{ model = \"{}\", {} = 0.4 }}\n", to.name,
        to.kind == FrictionKind::coulomb_viscous || to.kind == FrictionKind::dahl ? "dynamic"
                                                                                  : "static"));
    wanted.friction.coulomb = 0.0;
    wanted.friction.static_level = 0.0;
    expect_same_friction(with_friction_model(smooth, smooth, to.kind), wanted);
  }
}

TEST(FrictionExchange, KeepsTheLevelsAsTheyAreNow) {
  const Material baked =
      rubbed_material(friction_keys_of(FrictionKind::lugre, FrictionKind::lugre));
  Material now = baked;
  now.friction.coulomb = 0.7;
  now.friction.static_level = 0.9;
  now.friction.viscous_s_per_m = 0.2;
  const Material dahl = with_friction_model(now, baked, FrictionKind::dahl);
  EXPECT_EQ(dahl.friction.coulomb, 0.7);
  EXPECT_EQ(dahl.friction.static_level, 0.7);
  EXPECT_EQ(dahl.friction.viscous_s_per_m, 0.2);
  // The scene's static level is below the dynamic one by now.
  EXPECT_EQ(with_friction_model(dahl, baked, FrictionKind::cone).friction.static_level, 0.7);
}

}  // namespace
}  // namespace tactus::host
