#include "host_tools/bake/scene/needle_description.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <array>

#include "rendering/limits.h"

namespace tactus::host {
namespace {

using rendering::Needle;
using rendering::ShaftFriction;
using rendering::Tissue;

constexpr std::array kNeedleKeys{KeySpec{"axis", ""}, KeySpec{"length_m", "m"},
                                 KeySpec{"width_m", "m"},
                                 KeySpec{"tip_stiffness_N_per_m", "N_per_m"}};
constexpr std::array kShaftKeys{KeySpec{"static_N_per_m", "N_per_m"},
                                KeySpec{"dynamic_N_per_m", "N_per_m"},
                                KeySpec{"viscous_Ns_per_m2", "Ns_per_m2"}};
constexpr std::array kTissueKeys{KeySpec{"stiffness_N_per_m", "N_per_m"},
                                 KeySpec{"stiffness_N_per_m2", "N_per_m2"},
                                 KeySpec{"puncture_force_N", "N"},
                                 KeySpec{"residual_m", "m"},
                                 KeySpec{"cutting_force_N", "N"},
                                 KeySpec{"toughness_J_per_m2", "J_per_m2"},
                                 kShaftKeys[0],
                                 kShaftKeys[1],
                                 kShaftKeys[2],
                                 KeySpec{"clamping", ""},
                                 KeySpec{"withdrawal", ""},
                                 KeySpec{"shaft_stiffness_N_per_m2", "N_per_m2"},
                                 KeySpec{"lateral_stiffness_N_per_m2", "N_per_m2"},
                                 KeySpec{"relaxation_s", "s"}};

// Returns a number from 0 to a limit, or what it is without the key.
double number(const TomlSection& section, std::string_view key, double most, double otherwise) {
  const double value = section.number(key, kZeroOrMore).value_or(otherwise);
  if (value > most) {
    section.fail(key, fmt::format("{} is {}, where {} is the most; see the unit in its name", key,
                                  value, most));
  }
  return value;
}

double force(const TomlSection& section, std::string_view key) {
  return number(section, key, rendering::kMostNeedleForce_N, 0.0);
}

double stiffness(const TomlSection& section, std::string_view key, double otherwise = 0.0) {
  return number(section, key, rendering::kMostNeedleStiffness, otherwise);
}

ShaftFriction read_shaft(const TomlSection& section) {
  ShaftFriction friction{.dynamic_N_per_m = stiffness(section, "dynamic_N_per_m"),
                         .viscous_Ns_per_m2 = stiffness(section, "viscous_Ns_per_m2")};
  friction.static_N_per_m = stiffness(section, "static_N_per_m", friction.dynamic_N_per_m);
  if (friction.dynamic_N_per_m > friction.static_N_per_m) {
    section.fail("dynamic_N_per_m",
                 fmt::format("dynamic_N_per_m is {}, more than static_N_per_m, {}; a shaft at rest "
                             "holds at least as much as one that slides",
                             friction.dynamic_N_per_m, friction.static_N_per_m));
  }
  return friction;
}

// Returns the friction on the way out: a table of its own, or the one on the way in times
// `clamping`.
ShaftFriction read_withdrawal(const TomlSection& section, std::string_view file,
                              const ShaftFriction& in) {
  const toml::table* const table = section.table("withdrawal");
  if (table != nullptr && section.has("clamping")) {
    section.fail("clamping", "clamping and withdrawal say the same; leave one of the two out");
  }
  if (table != nullptr) {
    return read_shaft(TomlSection(*table, file, section.title() + " withdrawal", kShaftKeys));
  }
  const double clamping = number(section, "clamping", rendering::kMostNeedleForce_N, 1.0);
  return {.static_N_per_m = clamping * in.static_N_per_m,
          .dynamic_N_per_m = clamping * in.dynamic_N_per_m,
          .viscous_Ns_per_m2 = clamping * in.viscous_Ns_per_m2};
}

// Sets the cutting force and the toughness: each follows from the other where it is left out.
void read_cutting(const TomlSection& section, const Needle& needle, Tissue& tissue) {
  tissue.toughness_J_per_m2 = stiffness(section, "toughness_J_per_m2");
  tissue.cutting_force_N = force(section, "cutting_force_N");
  if (!section.has("toughness_J_per_m2")) {
    tissue.toughness_J_per_m2 = tissue.cutting_force_N / needle.width_m;
  }
  if (!section.has("cutting_force_N")) {
    tissue.cutting_force_N = fracture_force_N(tissue, needle);
  }
  if (fracture_force_N(tissue, needle) > (1.0 + 1e-9) * tissue.cutting_force_N) {
    section.fail("toughness_J_per_m2",
                 fmt::format("a crack of {} m takes {} N, more than cutting_force_N, {}; write "
                             "toughness_J_per_m2 = {} or less",
                             needle.width_m, fracture_force_N(tissue, needle),
                             tissue.cutting_force_N, tissue.cutting_force_N / needle.width_m));
  }
}

void read_membrane(const TomlSection& section, Tissue& tissue) {
  tissue.stiffness_N_per_m = stiffness(section, "stiffness_N_per_m");
  tissue.stiffness_N_per_m2 = stiffness(section, "stiffness_N_per_m2");
  tissue.puncture_force_N = force(section, "puncture_force_N");
  if (tissue.puncture_force_N > 0.0 &&
      !(tissue.stiffness_N_per_m + tissue.stiffness_N_per_m2 > 0.0)) {
    section.fail("puncture_force_N",
                 "the surface has no stiffness, so that it never reaches puncture_force_N; add "
                 "stiffness_N_per_m or stiffness_N_per_m2");
  }
}

void read_residual(const TomlSection& section, const Needle& needle, Tissue& tissue) {
  const double depth_m = puncture_depth_m(tissue);
  const double least_m = least_residual_m(tissue, needle);
  tissue.residual_m =
      section.number("residual_m", kZeroOrMore).value_or(balanced_residual_m(tissue));
  if (tissue.residual_m > depth_m) {
    section.fail("residual_m", fmt::format("residual_m is {} m, and the surface gives way at {} m; "
                                           "write less, or leave it out",
                                           tissue.residual_m, depth_m));
  }
  if (tissue.residual_m < least_m) {
    section.fail(
        "residual_m",
        fmt::format("residual_m is {} m, where {} m is the least: the surface stores {} J, "
                    "and the crack as far as the tip would take more; leave it out, or "
                    "lessen toughness_J_per_m2",
                    tissue.residual_m, least_m, membrane_energy_J(tissue, depth_m)));
  }
}

// Throws InputError for an object that a needle cannot pierce.
void require_pierceable(const TomlSection& object, const ShapeDescription& shape,
                        const MotionDescription& motion) {
  if (!std::holds_alternative<std::monostate>(shape) &&
      !std::holds_alternative<rendering::Primitive>(shape)) {
    object.fail("tissue",
                "a needle pierces meshes and primitives; write contact = \"sphere_proxy\", which "
                "bakes the formula as a mesh");
  }
  if (motion.deforms) {
    object.fail("deforms", "a layer of tissue is rigid; leave out deforms or the tissue");
  }
  if (object.has("body")) {
    object.fail("body", "a needle does not pierce bodies; leave out the body or the tissue");
  }
}

}  // namespace

std::optional<Needle> read_needle(const TomlSection& tool, std::string_view file) {
  const toml::table* const table = tool.table("needle");
  if (table == nullptr) {
    return std::nullopt;
  }
  const TomlSection section(*table, file, "[tool.needle]", kNeedleKeys);
  Needle needle;
  if (!section.has("length_m")) {
    section.fail("length_m",
                 "length_m is missing; write the length of the shaft, as in "
                 "length_m = 0.09");
  }
  const auto length = [&](std::string_view key, double otherwise) {
    const double value = section.number(key, kAboveZero).value_or(otherwise);
    if (value > rendering::kMaxToolRadius_m) {
      section.fail(key, fmt::format("{} is {} m, where {} m is the most; is it in millimetres?",
                                    key, value, rendering::kMaxToolRadius_m));
    }
    return value;
  };
  needle.length_m = length("length_m", needle.length_m);
  needle.width_m = length("width_m", needle.width_m);
  needle.tip_stiffness_N_per_m =
      section.number("tip_stiffness_N_per_m", kAboveZero).value_or(needle.tip_stiffness_N_per_m);
  if (needle.tip_stiffness_N_per_m > rendering::kMostNeedleStiffness) {
    section.fail("tip_stiffness_N_per_m",
                 fmt::format("tip_stiffness_N_per_m is {}, where {} is the most",
                             needle.tip_stiffness_N_per_m, rendering::kMostNeedleStiffness));
  }
  if (const auto direction = section.vector("axis")) {
    if (!(direction->norm() > 0.0)) {
      section.fail("axis",
                   "axis has no length; write the direction in which the needle pierces, "
                   "as in [0.0, -1.0, 0.0]");
    }
    needle.axis_W = direction->normalized();
  }
  return needle;
}

std::optional<Tissue> read_tissue(const TomlSection& object, std::string_view file,
                                  const ShapeDescription& shape, const MotionDescription& motion,
                                  const std::optional<Needle>& needle) {
  const toml::table* const table = object.table("tissue");
  if (table == nullptr) {
    return std::nullopt;
  }
  if (!needle) {
    object.fail("tissue",
                "a needle alone meets tissue, and there is none; add [tool.needle] with length_m, "
                "or leave out the tissue");
  }
  require_pierceable(object, shape, motion);
  const TomlSection section(*table, file, object.title() + " tissue", kTissueKeys);
  Tissue tissue;
  read_membrane(section, tissue);
  read_cutting(section, *needle, tissue);
  tissue.in = read_shaft(section);
  tissue.out = read_withdrawal(section, file, tissue.in);
  tissue.shaft_stiffness_N_per_m2 = section.number("shaft_stiffness_N_per_m2", kAboveZero)
                                        .value_or(tissue.shaft_stiffness_N_per_m2);
  tissue.lateral_stiffness_N_per_m2 = stiffness(section, "lateral_stiffness_N_per_m2");
  tissue.relaxation_s =
      number(section, "relaxation_s", rendering::kMostNeedleForce_N, tissue.relaxation_s);
  read_residual(section, *needle, tissue);
  if (!valid(tissue, *needle)) {
    section.fail("shaft_stiffness_N_per_m2",
                 "a number is out of range; see the units in the names");
  }
  return tissue;
}

}  // namespace tactus::host
