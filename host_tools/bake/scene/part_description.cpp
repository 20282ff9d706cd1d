#include "host_tools/bake/scene/part_description.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include "host_tools/bake/scene/placement_description.h"
#include "host_tools/bake/scene/shape_description.h"
#include "rendering/bodies/primitive_hull.h"
#include "rendering/limits.h"

namespace tactus::host {
namespace {

// Returns the keys of a part: those of a convex primitive or a mesh, and of its place.
std::vector<KeySpec> part_keys() {
  std::vector<KeySpec> keys = primitive_keys();
  keys.insert(keys.end(), {KeySpec{"mesh", ""}, KeySpec{"scale", ""}, KeySpec{"position_m", "m"},
                           KeySpec{"rotation", ""}});
  return keys;
}

// Returns a place in the object's frame as one in the frame of the scene.
Placement placed_on(const Placement& object, const Placement& part) {
  return {.longest_side_m = std::nullopt,
          .scale = part.scale,
          .rotation = object.rotation * part.rotation,
          .position_m = object.position_m + object.rotation * part.position_m};
}

PartDescription read_part(const toml::table& table, const std::string& title, std::string_view file,
                          const std::filesystem::path& folder, const Placement& object) {
  const std::vector<KeySpec> keys = part_keys();
  const TomlSection section(table, file, title, keys);
  const std::optional<std::string> name = section.text("primitive");
  const std::optional<std::string> mesh = section.text("mesh");
  if (name.has_value() == mesh.has_value()) {
    section.fail(mesh ? "mesh" : "primitive",
                 "a part is either primitive = \"box\" or mesh = \"part.obj\"; write one of the "
                 "two");
  }
  PartDescription part{.line = section.line(mesh ? "mesh" : "primitive"),
                       .primitive = std::nullopt,
                       .mesh = mesh ? folder / *mesh : std::filesystem::path{},
                       .placement = placed_on(object, read_placement(section, file))};
  if (mesh) {
    return part;
  }
  if (section.has("scale")) {
    section.fail("scale", "scale is for the mesh of a part; leave it out");
  }
  part.primitive = read_primitive(section, *name, part.placement);
  if (!rendering::has_hull(part.primitive->kind)) {
    section.fail("primitive",
                 fmt::format("a part is convex and has a volume, which a {} is not; write "
                             "\"box\", \"sphere\", \"capsule\", \"cylinder\" or \"cone\"",
                             *name));
  }
  return part;
}

}  // namespace

std::vector<PartDescription> read_parts(const TomlSection& body, const toml::table& table,
                                        std::string_view file, const std::filesystem::path& folder,
                                        const Placement& placement) {
  std::vector<PartDescription> parts;
  const toml::node* const node = table.get("part");
  if (node == nullptr) {
    return parts;
  }
  const toml::array* const array = node->as_array();
  if (array == nullptr || array->empty() || !array->is_homogeneous(toml::node_type::table)) {
    body.fail("part", "the parts are no tables; write [[object.body.part]], with two brackets");
  }
  if (array->size() > rendering::kMaxPartsOfBody) {
    body.fail("part", fmt::format("{} parts, where {} fit a body; leave some out, or join them",
                                  array->size(), rendering::kMaxPartsOfBody));
  }
  for (const toml::node& part : *array) {
    const std::string title = fmt::format("{} part {}", body.title(), parts.size() + 1);
    parts.push_back(read_part(*part.as_table(), title, file, folder, placement));
  }
  return parts;
}

}  // namespace tactus::host
