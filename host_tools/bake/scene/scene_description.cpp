#include "host_tools/bake/scene/scene_description.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <array>

#include "host_tools/bake/scene/effect_description.h"
#include "host_tools/bake/scene/friction_description.h"
#include "host_tools/bake/scene/placement_description.h"
#include "host_tools/bake/toml/toml_file.h"
#include "host_tools/bake/toml/toml_section.h"
#include "host_tools/files/atomic_file.h"
#include "host_tools/input_error.h"
#include "host_tools/units.h"
#include "rendering/limits.h"
#include "rendering/objects/object_body.h"

namespace tactus::host {
namespace {

constexpr std::array kSceneKeys{KeySpec{"tool", ""}, KeySpec{"object", ""}, KeySpec{"effect", ""},
                                KeySpec{"device", ""}, KeySpec{"world", ""}};
constexpr std::array kWorldKeys{KeySpec{"gravity_m_per_s2", "m_per_s2"},
                                KeySpec{"sleep_after_s", "s"}};
constexpr std::array kToolKeys{KeySpec{"radius_m", "m"}, KeySpec{"count", ""},
                               KeySpec{"needle", ""}, KeySpec{"soft_finger_modulus_Pa", "Pa"}};
// The keys of an [[object]] that do not depend on its shape.
constexpr std::array kOwnKeys{
    KeySpec{"name", ""},
    KeySpec{"mesh", ""},
    KeySpec{"longest_side_m", "m"},
    KeySpec{"scale", ""},
    KeySpec{"position_m", "m"},
    KeySpec{"rotation", ""},
    KeySpec{"weld_m", "m"},
    KeySpec{"cap_holes_mm", "mm"},
    KeySpec{"flip", ""},
    KeySpec{"sides", ""},
    KeySpec{"stiffness_N_per_m", "N_per_m"},
    KeySpec{"damping_Ns_per_m", "Ns_per_m"},
    KeySpec{"friction", ""},
    KeySpec{"grain", ""},
    KeySpec{"contact", ""},
    KeySpec{"push_out_mm", "mm"},
    KeySpec{"shading", ""},
    KeySpec{"texture", ""},
    KeySpec{"moves", ""},
    KeySpec{"deforms", ""},
    KeySpec{"motion", ""},
    KeySpec{"body", ""},
    KeySpec{"tissue", ""},
};

// Returns the keys of an object: its own and those of its shape.
std::vector<KeySpec> object_keys() {
  std::vector<KeySpec> keys(kOwnKeys.begin(), kOwnKeys.end());
  std::ranges::copy(shape_keys(), std::back_inserter(keys));
  return keys;
}

// Returns from which sides the surface is touched; from one if the key is left out.
rendering::Sides read_sides(const TomlSection& section) {
  const std::string sides = section.text("sides").value_or("one");
  if (sides != "one" && sides != "two") {
    section.fail("sides", fmt::format(R"(sides is "{}"; write "one" or "two")", sides));
  }
  return sides == "one" ? rendering::Sides::one : rendering::Sides::two;
}

// Returns true if the faces of the mesh are turned around. Throws InputError for another shape.
bool read_flip(const TomlSection& section) {
  const bool flip = section.flag("flip").value_or(false);
  if (flip && !section.has("mesh")) {
    section.fail("flip", section.has("formula")
                             ? "flip is for meshes; negate the formula, as in -(x^2 + y^2 - 1)"
                             : "flip is for meshes; leave it out");
  }
  return flip;
}

// Throws InputError for friction that the contact method cannot render.
void require_renderable_friction(const TomlSection& section, const ObjectDescription& object) {
  if (!section.has("friction")) {
    return;
  }
  if (object.contact == rendering::ContactMethod::plain_tracking) {
    section.fail("friction", "plain_tracking has no friction; leave it out, or write \"tracking\"");
  }
  if (!rendering::renders_friction(object.contact, object.material.friction)) {
    section.fail(
        "friction",
        "a textbook's method has the friction cone only; write model = \"cone\", or leave out "
        "contact");
  }
}

// Reads how a mesh is cleaned. Throws InputError for holes of another shape.
MeshBakeOptions read_mesh_options(const TomlSection& section) {
  if (section.has("cap_holes_mm") && !section.has("mesh")) {
    section.fail("cap_holes_mm", "cap_holes_mm is for meshes; leave it out");
  }
  return {.weld_m = section.number("weld_m", kZeroOrMore).value_or(0.0),
          .cap_holes_m = kMillimetre_m * section.number("cap_holes_mm", kZeroOrMore).value_or(0.0)};
}

// Reads one [[object]]. A relative path of the mesh begins at `folder`, the scene file's own.
ObjectDescription read_object(const toml::table& table, std::size_t index, std::string_view file,
                              const std::filesystem::path& folder,
                              const std::optional<rendering::Needle>& needle) {
  const std::vector<KeySpec> keys = object_keys();
  const TomlSection section(table, file, fmt::format("object {}", index + 1), keys);
  ObjectDescription object;
  object.placement = read_placement(section, file);
  object.shape = read_shape(section, object.placement);
  object.contact = read_contact(section, object.shape);
  if (const std::optional<std::string> mesh = section.text("mesh")) {
    object.mesh = folder / *mesh;
  }
  object.line = section.line(section.has("mesh")        ? "mesh"
                             : section.has("primitive") ? "primitive"
                                                        : "formula");
  object.name = section.text("name").value_or(object.mesh.empty()
                                                  ? section.text("primitive").value_or("formula")
                                                  : object.mesh.stem().string());
  object.sides = read_sides(section);
  object.material.stiffness_N_per_m =
      section.number("stiffness_N_per_m", kZeroOrMore).value_or(kDefaultStiffness_N_per_m);
  object.material.damping_Ns_per_m = section.number("damping_Ns_per_m", kZeroOrMore).value_or(0.0);
  object.material.friction = read_friction(section, file, object.material.stiffness_N_per_m);
  object.friction_line = section.line("friction");
  require_renderable_friction(section, object);
  if (const auto push_out_mm = section.number("push_out_mm", kZeroOrMore)) {
    object.push_out_m = kMillimetre_m * *push_out_mm;
  }
  object.material.grain = read_grain(section, file, object.contact);
  const bool is_meshed = meshed_formula(object.shape, object.contact) != nullptr;
  const ShapeDescription touched = is_meshed ? ShapeDescription{} : object.shape;
  object.motion = read_motion(section, file, touched, object.contact, object.placement.position_m);
  object.body = read_body(
      section, file, {.folder = folder, .placement = object.placement, .contact = object.contact},
      object.motion);
  object.tissue = read_tissue(section, file, touched, object.motion, needle);
  object.detail = read_detail(section, file, folder, touched, object.contact);
  object.flip = read_flip(section);
  object.mesh_options = read_mesh_options(section);
  return object;
}

// Returns the effects of all [[effect]] tables; none if there are none.
std::vector<rendering::Effect> read_effects(const toml::table& root, const TomlSection& scene,
                                            std::string_view file) {
  std::vector<rendering::Effect> effects;
  const toml::node* node = root.get("effect");
  if (node == nullptr) {
    return effects;
  }
  const toml::array* array = node->as_array();
  if (array == nullptr || !array->is_homogeneous(toml::node_type::table)) {
    scene.fail("effect", "[effect] is a single table; write [[effect]], with two brackets");
  }
  if (array->size() > rendering::kMaxEffects) {
    scene.fail("effect", fmt::format("{} effects, where {} fit; leave some out", array->size(),
                                     rendering::kMaxEffects));
  }
  for (const toml::node& effect : *array) {
    effects.push_back(read_effect(*effect.as_table(), effects.size(), file));
  }
  return effects;
}

// Returns the [[object]] tables. Throws InputError if there is none or too many.
const toml::array& object_array(const toml::table& root, const TomlSection& scene) {
  const toml::node* node = root.get("object");
  const toml::array* array = node == nullptr ? nullptr : node->as_array();
  if (node != nullptr && node->is_table()) {
    scene.fail("object", "[object] is a single table; write [[object]], with two brackets");
  }
  if (array == nullptr || array->empty() || !array->is_homogeneous(toml::node_type::table)) {
    scene.fail("object", "there is no [[object]]; add one with a mesh, a primitive or a formula");
  }
  if (array->size() > rendering::kMaxObjects) {
    scene.fail("object", fmt::format("{} objects, where {} fit; leave some out", array->size(),
                                     rendering::kMaxObjects));
  }
  return *array;
}

// Throws InputError if an object of that name is there.
void require_distinct_name(std::span<const ObjectDescription> others, const std::string& name,
                           std::string_view file, std::size_t line) {
  if (std::ranges::find(others, name, &ObjectDescription::name) != others.end()) {
    throw InputError(
        fmt::format("{}:{}: two objects are named '{}'; give each its own name", file, line, name));
  }
}

// Returns the effective modulus of soft fingers, Pa, or 0. Throws InputError for a tool that is a
// point, and for a modulus that is none.
double read_finger_modulus(const TomlSection& tool, double radius_m) {
  constexpr const char* kKey = "soft_finger_modulus_Pa";
  const std::optional<double> modulus_Pa = tool.number(kKey, kAboveZero);
  if (!modulus_Pa) {
    return 0.0;
  }
  if (!(radius_m > 0.0)) {
    tool.fail(kKey, "a tool of radius 0 touches in a point; give it a radius_m, or leave this out");
  }
  if (!rendering::is_finger_modulus(*modulus_Pa)) {
    tool.fail(kKey,
              fmt::format("the modulus is {} Pa, where {} Pa is the least; is it in megapascals "
                          "or kilopascals?",
                          *modulus_Pa, rendering::kLeastFingerModulus_Pa));
  }
  return *modulus_Pa;
}

// Reads [world], if there is one, into the scene.
void read_world(const TomlSection& section, SceneDescription& scene) {
  const toml::table* const world = section.table("world");
  if (world == nullptr) {
    return;
  }
  const TomlSection world_section(*world, scene.file, "[world]", kWorldKeys);
  scene.gravity_W = world_section.vector("gravity_m_per_s2");
  if (scene.gravity_W && scene.gravity_W->norm() > rendering::kMostGravity_m_per_s2) {
    world_section.fail("gravity_m_per_s2",
                       fmt::format("the gravity is {} m/s^2, where {} is the most; the earth's "
                                   "is [0.0, -9.80665, 0.0]",
                                   scene.gravity_W->norm(), rendering::kMostGravity_m_per_s2));
  }
  scene.sleep_after_s = world_section.number("sleep_after_s", kZeroOrMore).value_or(0.0);
  if (!rendering::is_sleep_time(scene.sleep_after_s)) {
    world_section.fail(
        "sleep_after_s",
        fmt::format("bodies fall asleep after {} s, where {} s is the least; write 0 "
                    "for bodies that never sleep",
                    scene.sleep_after_s, rendering::kLeastSleepAfter_s));
  }
}

}  // namespace

SceneDescription parse_scene_description(std::string_view text, const std::filesystem::path& path) {
  SceneDescription scene{.file = path.string(), .tool_radius_m = kDefaultToolRadius_m};
  const toml::table root = parse_toml(text, scene.file);
  const TomlSection section(root, scene.file, "scene", kSceneKeys);
  if (const toml::table* tool = section.table("tool")) {
    const TomlSection tool_section(*tool, scene.file, "[tool]", kToolKeys);
    scene.tool_radius_m =
        tool_section.number("radius_m", kZeroOrMore).value_or(kDefaultToolRadius_m);
    if (scene.tool_radius_m > rendering::kMaxToolRadius_m) {
      tool_section.fail(
          "radius_m", fmt::format("radius_m is {} m, where {} m is the most; is it in millimetres?",
                                  scene.tool_radius_m, rendering::kMaxToolRadius_m));
    }
    scene.tool_count = tool_section.count("count", rendering::kMaxTools).value_or(1);
    scene.needle = read_needle(tool_section, scene.file);
    scene.soft_finger_modulus_Pa = read_finger_modulus(tool_section, scene.tool_radius_m);
  }
  read_world(section, scene);
  scene.device = read_device(section, scene.file);
  scene.effects = read_effects(root, section, scene.file);
  for (const toml::node& node : object_array(root, section)) {
    const toml::table& table = *node.as_table();
    ObjectDescription object =
        read_object(table, scene.objects.size(), scene.file, path.parent_path(), scene.needle);
    require_distinct_name(scene.objects, object.name, scene.file, table.source().begin.line);
    scene.objects.push_back(std::move(object));
  }
  const auto tissues = std::ranges::count_if(
      scene.objects, [](const ObjectDescription& object) { return object.tissue.has_value(); });
  if (tissues > static_cast<std::ptrdiff_t>(rendering::kMaxTissues)) {
    section.fail("object", fmt::format("{} objects with tissue, where {} fit; leave some out",
                                       tissues, rendering::kMaxTissues));
  }
  return scene;
}

SceneDescription read_scene_description(const std::filesystem::path& path) {
  return parse_scene_description(read_file(path), path);
}

}  // namespace tactus::host
