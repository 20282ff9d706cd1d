#include "host_tools/bake/scene/effect_description.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <array>

#include "host_tools/bake/scene/placement_description.h"
#include "host_tools/bake/scene/shape_description.h"

namespace tactus::host {
namespace {

using rendering::EffectLaw;

// Keys that several laws share: a name with the unit that a wrong name is compared with.
constexpr KeySpec kLaw{"law", ""};
constexpr KeySpec kBound{"max_force_N", "N"};
constexpr KeySpec kPosition{"position_m", "m"};
constexpr KeySpec kStiffness{"stiffness_N_per_m", "N_per_m"};
constexpr KeySpec kDamping{"damping_Ns_per_m", "Ns_per_m"};
constexpr KeySpec kDirection{"direction", ""};
constexpr KeySpec kCapture{"capture_m", "m"};

// The keys that each law permits; any other key is refused with the nearest of these as advice.
constexpr std::array kSpringKeys{kLaw, kBound, kPosition, kStiffness};
constexpr std::array kSpringDamperKeys{kLaw, kBound, kPosition, kStiffness, kDamping};
constexpr std::array kDragKeys{kLaw,
                               kBound,
                               kPosition,
                               kDamping,
                               KeySpec{"quadratic_Ns2_per_m2", "Ns2_per_m2"},
                               KeySpec{"rim_m", "m"},
                               KeySpec{"rotation", ""},
                               KeySpec{"primitive", ""},
                               KeySpec{"radius_m", "m"},
                               KeySpec{"height_m", "m"},
                               KeySpec{"size_m", "m"},
                               KeySpec{"ring_radius_m", "m"},
                               KeySpec{"tube_radius_m", "m"}};
constexpr std::array kMagnetKeys{kLaw, kBound, kPosition, KeySpec{"strength_N", "N"},
                                 KeySpec{"core_m", "m"}};
constexpr std::array kFieldKeys{kLaw, kBound, KeySpec{"force_N", "N"}};
constexpr std::array kVibrationKeys{kLaw, kBound, kDirection, KeySpec{"amplitude_N", "N"},
                                    KeySpec{"frequency_Hz", "Hz"}};
constexpr std::array kStickSlipKeys{kLaw, kBound, kStiffness, KeySpec{"break_force_N", "N"}};
constexpr std::array kPointKeys{kLaw, kBound, kPosition, kStiffness, kDamping, kCapture};
constexpr std::array kLineKeys{kLaw, kBound, kPosition, kStiffness, kDamping, kCapture, kDirection};

// Returns a number that must be given. Throws InputError that shows `example`.
double required(const TomlSection& section, std::string_view key, NumberRange range,
                std::string_view example) {
  const std::optional<double> value = section.number(key, range);
  if (!value) {
    section.fail(key, fmt::format("{} is missing; write {} = {}", key, key, example));
  }
  return *value;
}

// Returns the stiffness, which must be given.
double stiffness_of(const TomlSection& section, NumberRange range = kZeroOrMore) {
  return required(section, kStiffness.name, range, "200.0");
}

// Returns the damping; 0 if it is left out.
double damping_of(const TomlSection& section) {
  return section.number(kDamping.name, kZeroOrMore).value_or(0.0);
}

// Returns three numbers that must be given. Throws InputError that shows `example`.
Vec3 vector_of(const TomlSection& section, std::string_view key, std::string_view example) {
  const std::optional<std::vector<double>> v = section.numbers(key, 3);
  if (!v) {
    section.fail(key, fmt::format("{} is missing; write {} = {}", key, key, example));
  }
  return {(*v)[0], (*v)[1], (*v)[2]};
}

// Returns the position in the world, m; the origin if the key is left out.
Vec3 position_of(const TomlSection& section) {
  return section.has(kPosition.name) ? vector_of(section, kPosition.name, "") : Vec3::Zero();
}

// Returns a unit vector.
Vec3 direction_of(const TomlSection& section) {
  const Vec3 direction = vector_of(section, kDirection.name, "[0.0, 1.0, 0.0]");
  if (!(direction.norm() > 0.0)) {
    section.fail(kDirection.name, "direction is zero; write one as in [0.0, 1.0, 0.0]");
  }
  return direction.normalized();
}

// Returns the spring that the three snap laws share.
rendering::SnapLaw snap_of(const TomlSection& section) {
  return {.stiffness_N_per_m = stiffness_of(section),
          .damping_Ns_per_m = damping_of(section),
          .capture_m = required(section, kCapture.name, kAboveZero, "0.01")};
}

EffectLaw read_spring(const TomlSection& section, std::string_view /*file*/) {
  return rendering::Spring{.anchor_W = position_of(section),
                           .stiffness_N_per_m = stiffness_of(section)};
}

EffectLaw read_spring_damper(const TomlSection& section, std::string_view /*file*/) {
  return rendering::SpringDamper{
      .spring = {.anchor_W = position_of(section), .stiffness_N_per_m = stiffness_of(section)},
      .damping_Ns_per_m = damping_of(section)};
}

// The volume is a primitive with the keys of an [[object]].
EffectLaw read_fluid_drag(const TomlSection& section, std::string_view file) {
  const std::optional<std::string> volume = section.text("primitive");
  if (!volume) {
    section.fail("primitive",
                 "the volume is missing; write primitive = \"sphere\" and radius_m = 0.05");
  }
  return rendering::FluidDrag{
      .volume = read_primitive(section, *volume, read_placement(section, file)),
      .linear_Ns_per_m = damping_of(section),
      .quadratic_Ns2_per_m2 = section.number("quadratic_Ns2_per_m2", kZeroOrMore).value_or(0.0),
      .rim_m = section.number("rim_m", kZeroOrMore).value_or(0.0)};
}

// A negative strength pushes away.
EffectLaw read_magnet(const TomlSection& section, std::string_view /*file*/) {
  return rendering::Magnet{.pole_W = position_of(section),
                           .strength_N = required(section, "strength_N", kAnyNumber, "2.0"),
                           .core_m = required(section, "core_m", kAboveZero, "0.01")};
}

EffectLaw read_constant_field(const TomlSection& section, std::string_view /*file*/) {
  return rendering::ConstantField{.force_W = vector_of(section, "force_N", "[0.0, -0.5, 0.0]")};
}

EffectLaw read_vibration(const TomlSection& section, std::string_view /*file*/) {
  return rendering::Vibration{
      .direction_W = direction_of(section),
      .amplitude_N = required(section, "amplitude_N", kZeroOrMore, "0.3"),
      .frequency_Hz = required(section, "frequency_Hz", kZeroOrMore, "120.0")};
}

EffectLaw read_stick_slip(const TomlSection& section, std::string_view /*file*/) {
  return rendering::StickSlip{
      .stiffness_N_per_m = stiffness_of(section, kAboveZero),
      .break_force_N = required(section, "break_force_N", kZeroOrMore, "0.5")};
}

EffectLaw read_snap_to_point(const TomlSection& section, std::string_view /*file*/) {
  return rendering::SnapToPoint{.point_W = position_of(section), .law = snap_of(section)};
}

EffectLaw read_snap_to_line(const TomlSection& section, std::string_view /*file*/) {
  return rendering::SnapToLine{.point_W = position_of(section),
                               .direction_W = direction_of(section),
                               .law = snap_of(section)};
}

EffectLaw read_snap_to_plane(const TomlSection& section, std::string_view /*file*/) {
  return rendering::SnapToPlane{
      .point_W = position_of(section), .normal_W = direction_of(section), .law = snap_of(section)};
}

// A law of rendering/effects with its name in TOML, its keys and its reader. A new law is one
// reader and one line in kLaws.
struct NamedLaw {
  std::string_view name;
  std::span<const KeySpec> keys;
  EffectLaw (*read)(const TomlSection& section, std::string_view file);
};
// In the order of rendering::EffectLaw.
constexpr std::array kLaws{
    NamedLaw{"spring", kSpringKeys, read_spring},
    NamedLaw{"spring_damper", kSpringDamperKeys, read_spring_damper},
    NamedLaw{"fluid_drag", kDragKeys, read_fluid_drag},
    NamedLaw{"magnet", kMagnetKeys, read_magnet},
    NamedLaw{"constant_field", kFieldKeys, read_constant_field},
    NamedLaw{"vibration", kVibrationKeys, read_vibration},
    NamedLaw{"stick_slip", kStickSlipKeys, read_stick_slip},
    NamedLaw{"snap_to_point", kPointKeys, read_snap_to_point},
    NamedLaw{"snap_to_line", kLineKeys, read_snap_to_line},
    NamedLaw{"snap_to_plane", kLineKeys, read_snap_to_plane},
};
static_assert(kLaws.size() == std::variant_size_v<EffectLaw>);

// Returns the law that the table names.
const NamedLaw& law_of(const toml::table& table, const std::string& title, std::string_view file) {
  // Which keys are permitted is known only once the law is, so all are permitted here.
  std::vector<KeySpec> any;
  for (const auto& [key, node] : table) {
    any.push_back({key.str(), ""});
  }
  const TomlSection section(table, file, title, any);
  const std::optional<std::string> name = section.text("law");
  const auto* const law = std::ranges::find(kLaws, name.value_or(""), &NamedLaw::name);
  if (law == kLaws.end()) {
    std::string names;
    for (const NamedLaw& one : kLaws) {
      names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", one.name);
    }
    section.fail("law", name ? fmt::format("no law \"{}\"; write one of {}", *name, names)
                             : fmt::format("the law is missing; write law = one of {}", names));
  }
  return *law;
}

}  // namespace

rendering::Effect read_effect(const toml::table& table, std::size_t index, std::string_view file) {
  const std::string title = fmt::format("effect {}", index + 1);
  const NamedLaw& law = law_of(table, title, file);
  const TomlSection section(table, file, title, law.keys);
  const rendering::Effect effect{.law = law.read(section, file),
                                 .max_force_N = required(section, kBound.name, kAboveZero, "3.0")};
  if (!valid(effect)) {
    section.fail("law", fmt::format("the {} has a number out of range; correct it", law.name));
  }
  return effect;
}

}  // namespace tactus::host
