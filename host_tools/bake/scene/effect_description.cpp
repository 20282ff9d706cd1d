#include "host_tools/bake/scene/effect_description.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include <algorithm>
#include <array>

#include "host_tools/bake/scene/placement_description.h"
#include "host_tools/bake/scene/shape_description.h"

namespace tactus::host {
namespace {

using rendering::EffectLaw;
using rendering::EffectLaws;
using rendering::FieldRange;
using rendering::kEffectLawNames;
using rendering::NumberField;
using rendering::VectorField;
using rendering::VectorUse;
using rendering::VolumeField;

// Keys that several laws share: a name with the unit that a wrong name is compared with.
constexpr KeySpec kLaw{"law", ""};
constexpr NumberField kBound{
    .key = "max_force_N", .unit = "N", .range = FieldRange::above_zero, .example = "3.0"};

NumberRange range_of(const NumberField& field) {
  switch (field.range) {
    case FieldRange::above_zero:
      return kAboveZero;
    case FieldRange::zero_or_more:
      return kZeroOrMore;
    default:
      return kAnyNumber;
  }
}

// Collects the keys of a law's fields.
class KeyList {
 public:
  KeyList() { (*this)(kBound, 0.0); }

  void operator()(const NumberField& field, double /*value*/) {
    keys_.push_back({field.key, field.unit});
  }
  void operator()(const VectorField& field, const Vec3& /*value*/) {
    keys_.push_back({field.key, field.unit});
  }
  void operator()(const VolumeField& /*field*/, const rendering::Primitive& /*value*/) {
    keys_.push_back({"position_m", "m"});
    keys_.push_back({"rotation", ""});
    std::ranges::copy(primitive_keys(), std::back_inserter(keys_));
  }
  [[nodiscard]] std::span<const KeySpec> keys() const { return keys_; }

 private:
  std::vector<KeySpec> keys_{kLaw};
};

// Reads a law's fields. A field that may be left out keeps the law's own value.
class FieldReader {
 public:
  FieldReader(const TomlSection& section, std::string_view file) : section_(section), file_(file) {}

  void operator()(const NumberField& field, double& value) const {
    const std::optional<double> given = section_.number(field.key, range_of(field));
    if (!given && !field.example.empty()) {
      fail_missing(field.key, field.example);
    }
    value = given.value_or(value);
  }
  void operator()(const VectorField& field, Vec3& value) const {
    const std::optional<Vec3> given = section_.vector(field.key);
    if (given) {
      value = *given;
    } else if (field.use != VectorUse::place) {
      fail_missing(field.key, field.example);
    }
    if (field.use != VectorUse::direction) {
      return;
    }
    if (!(value.norm() > 0.0)) {
      section_.fail(field.key,
                    fmt::format("{} is zero; write one as in {}", field.key, field.example));
    }
    value.normalize();
  }
  void operator()(const VolumeField& /*field*/, rendering::Primitive& value) const {
    const std::optional<std::string> volume = section_.text("primitive");
    if (!volume) {
      section_.fail("primitive",
                    "the volume is missing; write primitive = \"sphere\" and radius_m = 0.05");
    }
    value = read_primitive(section_, *volume, read_placement(section_, file_));
  }

 private:
  [[noreturn]] void fail_missing(std::string_view key, std::string_view example) const {
    section_.fail(key, fmt::format("{} is missing; write {} = {}", key, key, example));
  }

  const TomlSection& section_;
  std::string_view file_;
};

// Returns the number of the law that the table names.
std::size_t law_number(const toml::table& table, const std::string& title, std::string_view file) {
  // The keys are known once the law is: here any is.
  std::vector<KeySpec> any;
  for (const auto& [key, node] : table) {
    any.push_back({key.str(), ""});
  }
  const TomlSection section(table, file, title, any);
  const std::optional<std::string> name = section.text("law");
  const auto* const law = std::ranges::find(kEffectLawNames, name.value_or(""));
  if (law == kEffectLawNames.end()) {
    const std::string names = fmt::format("\"{}\"", fmt::join(kEffectLawNames, "\", \""));
    section.fail("law", name ? fmt::format("no law \"{}\"; write one of {}", *name, names)
                             : fmt::format("the law is missing; write law = one of {}", names));
  }
  return static_cast<std::size_t>(law - kEffectLawNames.begin());
}

template <class Law>
rendering::Effect read_as(const toml::table& table, const std::string& title,
                          std::string_view file) {
  rendering::Effect effect;
  Law law;
  KeyList keys;
  Law::visit_fields(law, keys);
  const TomlSection section(table, file, title, keys.keys());
  FieldReader reader(section, file);
  Law::visit_fields(law, reader);
  reader(kBound, effect.max_force_N);
  effect.law = law;
  if (!valid(effect)) {
    section.fail("law", fmt::format("the {} has a number out of range; correct it", Law::kName));
  }
  return effect;
}

}  // namespace

rendering::Effect read_effect(const toml::table& table, std::size_t index, std::string_view file) {
  const std::string title = fmt::format("effect {}", index + 1);
  return visit_number(
      EffectLaws{}, law_number(table, title, file),
      [&]<class Law>(std::type_identity<Law> /*law*/) { return read_as<Law>(table, title, file); });
}

}  // namespace tactus::host
