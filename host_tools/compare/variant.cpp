#include "host_tools/compare/variant.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "host_tools/input_error.h"
#include "host_tools/units.h"
#include "rendering/friction/registered_models.h"

namespace tactus::host {
namespace {

using rendering::kContactMethods;

struct NamedSides {
  std::string_view name;
  rendering::Sides sides;
};
constexpr auto kSides =
    std::to_array<NamedSides>({{"one", rendering::Sides::one}, {"two", rendering::Sides::two}});

// Returns the entry of that name in a table. Throws InputError that lists the names.
template <class Table>
const auto& named(const Table& table, std::string_view name, std::string_view what) {
  const auto found =
      std::ranges::find_if(table, [&](const auto& entry) { return entry.name == name; });
  if (found == table.end()) {
    std::vector<std::string_view> names;
    std::ranges::transform(table, std::back_inserter(names),
                           [](const auto& entry) { return entry.name; });
    throw InputError(
        fmt::format("there is no {} \"{}\"; write some of {}", what, name, fmt::join(names, ", ")));
  }
  return *found;
}

void require(double number, bool is_good, std::string_view option, std::string_view range) {
  if (!std::isfinite(number) || !is_good) {
    throw InputError(fmt::format("{} has {}; write numbers {}", option, number, range));
  }
}

// Replaces the variants by one for each of them and each value; `change` sets the value and returns
// its name. A list of one value is in the names only if `is_named_alone`: it makes no difference.
template <class Values, class Change>
void multiply(std::vector<Variant>& variants, const Values& values, bool is_named_alone,
              const Change& change) {
  if (values.empty()) {
    return;
  }
  std::vector<Variant> all;
  for (const Variant& variant : variants) {
    for (const auto& value : values) {
      Variant& one = all.emplace_back(variant);
      const std::string name = change(one, value);
      if (values.size() > 1 || is_named_alone) {
        one.name += (one.name.empty() ? "" : ", ") + name;
      }
    }
  }
  variants = std::move(all);
}

// Throws InputError if the variant's method cannot render the object.
void require_renderable(const SceneDescription& scene, const ObjectDescription& object) {
  const std::string_view needs = surface_needed(object.contact, object.shape);
  const std::string place = fmt::format("{}:{}: object {}", scene.file, object.line, object.name);
  const std::string_view method =
      std::ranges::find(kContactMethods, object.contact, &rendering::NamedContactMethod::method)
          ->name;
  if (!needs.empty()) {
    throw InputError(
        fmt::format("{}: {} is for {}; name other objects with --object, or leave the method out",
                    place, method, needs));
  }
  if (!rendering::renders_friction(object.contact, object.material.friction)) {
    const bool is_plain = object.contact == rendering::ContactMethod::plain_tracking;
    throw InputError(fmt::format("{}: {} has {}; leave the friction or the method out", place,
                                 method, is_plain ? "no friction" : "the friction cone only"));
  }
  const bool has_detail = object.detail.angle_limit_deg || !object.detail.textures.empty();
  if (has_detail && !rendering::renders_detail(object.contact)) {
    throw InputError(
        fmt::format("{}: {} renders neither shading nor textures; leave them out", place, method));
  }
}

void change_friction(const SceneDescription& scene, rendering::FrictionKind kind,
                     ObjectDescription& object) {
  rendering::FrictionParameters& friction = object.material.friction;
  if (!(friction.coulomb > 0.0)) {
    throw InputError(fmt::format(
        "{}:{}: object {} has no dynamic friction to compare models with; write friction = {{ "
        "static = 0.6, dynamic = 0.4 }}",
        scene.file, object.line, object.name));
  }
  friction.kind = kind;
  if (rendering::has_bristles(kind) && !(friction.stiffness_N_per_m > 0.0)) {
    friction.stiffness_N_per_m = object.material.stiffness_N_per_m;
  }
}

}  // namespace

std::vector<Variant> variants_of(const VariantLists& lists) {
  std::vector<Variant> variants(1);
  multiply(variants, lists.methods, true, [](Variant& variant, const std::string& name) {
    variant.method = named(kContactMethods, name, "contact method").method;
    return name;
  });
  multiply(variants, lists.frictions, false, [](Variant& variant, const std::string& name) {
    variant.friction = named(rendering::kFrictionModels, name, "friction model").kind;
    return name;
  });
  multiply(variants, lists.push_outs_mm, false, [](Variant& variant, double push_out_mm) {
    require(push_out_mm, push_out_mm >= 0.0, "--push-outs", "of millimetres, 0 or more");
    variant.push_out_m = kMillimetre_m * push_out_mm;
    return fmt::format("push-out {} mm", push_out_mm);
  });
  multiply(variants, lists.sides, false, [](Variant& variant, const std::string& name) {
    variant.sides = named(kSides, name, "number of sides").sides;
    return fmt::format("{} side{}", name, *variant.sides == rendering::Sides::one ? "" : "s");
  });
  multiply(variants, lists.rates_Hz, false, [](Variant& variant, double rate_Hz) {
    require(rate_Hz, rate_Hz > 0.0, "--rates", "of ticks in a second, above 0");
    variant.rate_Hz = rate_Hz;
    return fmt::format("{} Hz", rate_Hz);
  });
  for (auto variant = variants.begin(); variant != variants.end(); ++variant) {
    if (std::ranges::find(variants.begin(), variant, variant->name, &Variant::name) != variant) {
      throw InputError(fmt::format("{} is listed twice; leave one out", variant->name));
    }
  }
  if (variants.front().name.empty()) {
    variants.front().name = "as the scene has it";
  }
  return variants;
}

SceneDescription changed(SceneDescription scene, const Variant& variant, const std::string& name) {
  if (!name.empty() &&
      std::ranges::find(scene.objects, name, &ObjectDescription::name) == scene.objects.end()) {
    throw InputError(fmt::format("{}: there is no object \"{}\"", scene.file, name));
  }
  for (ObjectDescription& object : scene.objects) {
    if (!name.empty() && object.name != name) {
      continue;
    }
    object.contact = variant.method.value_or(object.contact);
    object.sides = variant.sides.value_or(object.sides);
    object.push_out_m = variant.push_out_m.value_or(object.push_out_m);
    if (variant.friction) {
      change_friction(scene, *variant.friction, object);
    }
    require_renderable(scene, object);
  }
  return scene;
}

}  // namespace tactus::host
