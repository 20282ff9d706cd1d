#include "host_tools/bake/scene/friction_description.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <iterator>

#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

using rendering::FrictionKind;
using rendering::FrictionParameters;

constexpr std::array kGrainKeys{KeySpec{"direction", ""}, KeySpec{"along", ""},
                                KeySpec{"across", ""}};

// Returns a key with the unit that its name ends with, for advice on a wrong unit.
KeySpec key_spec(std::string_view key) {
  constexpr std::array<std::string_view, 3> kUnits{"N_per_m", "s_per_m", "m_per_s"};
  const auto unit =
      std::ranges::find_if(kUnits, [key](std::string_view u) { return key.ends_with(u); });
  return {key, unit == kUnits.end() ? std::string_view{} : *unit};
}

// Returns the keys of all friction models.
std::vector<KeySpec> friction_keys() {
  std::vector<KeySpec> keys{{"model", ""}};
  std::ranges::transform(friction_parameter_names(), std::back_inserter(keys),
                         [](const auto& name) { return key_spec(name.surface_key); });
  return keys;
}

FrictionKind read_model(const TomlSection& section) {
  const std::optional<std::string> model = section.text("model");
  if (!model) {
    return FrictionKind::cone;
  }
  try {
    return friction_kind(*model);
  } catch (const InputError& error) {
    section.fail("model", error.what());
  }
}

// Throws InputError for a key that belongs to another friction model.
void refuse_keys_of_other_models(const TomlSection& section, FrictionKind kind) {
  const std::vector<FrictionParameterName> own = surface_parameters(kind);
  for (const FrictionParameterName& name : friction_parameter_names()) {
    const std::string_view key = name.surface_key;
    if (!section.has(key) ||
        std::ranges::find(own, key, &FrictionParameterName::surface_key) != own.end()) {
      continue;
    }
    std::vector<std::string_view> keys;
    std::ranges::transform(own, std::back_inserter(keys), &FrictionParameterName::surface_key);
    section.fail(key, fmt::format("model \"{}\" has no {}; it has {}", model_of(kind).name, key,
                                  fmt::join(keys, ", ")));
  }
}

// Returns a number between 0 and 1, both excluded.
std::optional<double> read_share(const TomlSection& section, std::string_view key) {
  const std::optional<double> share = section.number(key, kAboveZero);
  if (share && *share >= 1.0) {
    section.fail(key, fmt::format("{} is {}; write a number between 0 and 1", key, *share));
  }
  return share;
}

std::optional<double> read_parameter(const TomlSection& section,
                                     const FrictionParameterName& name) {
  switch (name.range) {
    case ParameterRange::zero_or_more:
      return section.number(name.surface_key, kZeroOrMore);
    case ParameterRange::above_zero:
      return section.number(name.surface_key, kAboveZero);
    default:
      return read_share(section, name.surface_key);
  }
}

// Completes the levels of static and sliding friction: whichever the scene leaves out equals the
// other. Throws InputError if sliding friction is above static.
void settle_levels(const TomlSection& section, bool has_static, FrictionParameters& friction) {
  if (has_static && !section.has("static")) {
    section.fail("static", "the coefficient static is missing; write static = 0.6");
  }
  if (!has_static && !section.has("dynamic")) {
    section.fail("dynamic", "the coefficient dynamic is missing; write dynamic = 0.4");
  }
  if (!has_static) {
    friction.static_level = friction.coulomb;
  } else if (!section.has("dynamic")) {
    friction.coulomb = friction.static_level;
  }
  if (friction.coulomb > friction.static_level) {
    section.fail("dynamic",
                 fmt::format("dynamic ({}) is above static ({}); sliding cannot hold more than "
                             "sticking, swap or lower it",
                             friction.coulomb, friction.static_level));
  }
  if (!rendering::rubs_at_rest(friction)) {
    section.fail("dynamic", fmt::format("dynamic is 0, and \"{}\" then has no friction at rest "
                                        "either; write a number above 0",
                                        model_of(friction.kind).name));
  }
}

// Sets the stiffness of a model with bristles to the contact's unless it is given.
// Throws InputError if it is not above 0.
void settle_bristles(const TomlSection& section, double contact_stiffness_N_per_m,
                     FrictionParameters& friction) {
  if (!section.has("stiffness_N_per_m")) {
    friction.stiffness_N_per_m = contact_stiffness_N_per_m;
  }
  if (!(friction.stiffness_N_per_m > 0.0)) {
    section.fail("stiffness_N_per_m",
                 fmt::format("\"{}\" has bristles, and they need a stiffness above 0; write "
                             "stiffness_N_per_m = 500.0",
                             model_of(friction.kind).name));
  }
}

// Returns a factor from 0 to 1; 1 if it is not given.
double read_factor(const TomlSection& section, std::string_view key) {
  const double factor = section.number(key, kZeroOrMore).value_or(1.0);
  if (factor > 1.0) {
    section.fail(key, fmt::format("{} is {}; write a factor from 0 to 1, and the coefficients of "
                                  "the rougher direction under friction",
                                  key, factor));
  }
  return factor;
}

}  // namespace

std::vector<FrictionParameterName> surface_parameters(FrictionKind kind) {
  std::vector<FrictionParameterName> names = parameters_of(kind);
  std::erase_if(names, [kind](const FrictionParameterName& name) {
    return !rendering::has_on_surface(kind, name.member);
  });
  return names;
}

FrictionParameters read_friction(const TomlSection& object, std::string_view file,
                                 double contact_stiffness_N_per_m) {
  const toml::table* table = object.table("friction");
  if (table == nullptr) {
    return {};
  }
  const std::vector<KeySpec> keys = friction_keys();
  const TomlSection section(*table, file, object.title() + " friction", keys);
  FrictionParameters friction = rendering::kSurfaceFriction;
  friction.kind = read_model(section);
  refuse_keys_of_other_models(section, friction.kind);
  bool has_static = false;
  for (const FrictionParameterName& name : surface_parameters(friction.kind)) {
    friction.*name.member = read_parameter(section, name).value_or(friction.*name.member);
    has_static = has_static || name.member == &FrictionParameters::static_level;
  }
  settle_levels(section, has_static, friction);
  if (rendering::has_bristles(friction.kind)) {
    settle_bristles(section, contact_stiffness_N_per_m, friction);
  }
  return friction;
}

rendering::MaterialGrain read_grain(const TomlSection& object, std::string_view file,
                                    rendering::ContactMethod contact) {
  const toml::table* table = object.table("grain");
  if (table == nullptr) {
    return {};
  }
  if (!object.has("friction")) {
    object.fail("grain", "a grain without friction is not felt; write friction = { static = 0.6 }");
  }
  if (!rendering::renders_grain(contact)) {
    object.fail("grain",
                rendering::is_textbook(contact)
                    ? "a textbook's method has no grain; leave it out, or leave out contact"
                    : "a potential field has no friction and no grain; leave it out, or "
                      "leave out contact = \"potential_field\"");
  }
  const TomlSection section(*table, file, object.title() + " grain", kGrainKeys);
  const std::optional<Vec3> direction = section.vector("direction");
  if (!direction) {
    section.fail("direction", "the direction is missing; write direction = [1.0, 0.0, 0.0]");
  }
  // stableNorm() does not overflow for directions with huge components.
  const double length = direction->stableNorm();
  if (!(length > 0.0)) {
    section.fail("direction", "direction is zero; write direction = [1.0, 0.0, 0.0]");
  }
  if (!section.has("along") && !section.has("across")) {
    section.fail("across", "neither along nor across is given; write across = 0.4");
  }
  const auto part = [&](Eigen::Index i) { return static_cast<float>((*direction)[i] / length); };
  return {.direction_O = {part(0), part(1), part(2)},
          .along = read_factor(section, "along"),
          .across = read_factor(section, "across")};
}

}  // namespace tactus::host
