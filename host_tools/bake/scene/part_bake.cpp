#include "host_tools/bake/scene/part_bake.h"

#include <fmt/format.h>

#include <filesystem>

#include "host_tools/bake/mesh_file/mesh_import.h"
#include "host_tools/input_error.h"
#include "host_tools/units.h"
#include "rendering/limits.h"

namespace tactus::host {
namespace {

// Returns the hull of a part's mesh.
ConvexHull hull_of_part(const PartDescription& part, const std::string& place) {
  const ImportedMesh imported = import_mesh(part.mesh);
  try {
    const TriangleMesh mesh = host::place(imported, part.placement);
    return convex_hull(std::span<const rendering::Float3>(mesh.vertices));
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}: {}", place, part.mesh.string(), error.what()));
  }
}

}  // namespace

void check_parts(const SceneDescription& description) {
  std::size_t count = 0;
  for (const ObjectDescription& object : description.objects) {
    if (!object.body) {
      continue;
    }
    count += object.body->parts.size();
    for (const PartDescription& part : object.body->parts) {
      std::error_code error;
      if (!part.primitive && !std::filesystem::exists(part.mesh, error)) {
        throw InputError(
            fmt::format("{}:{}: there is no mesh file {}; correct the path, it starts from the "
                        "scene file's folder",
                        description.file, part.line, part.mesh.string()));
      }
    }
  }
  if (count > rendering::kMaxBodyParts) {
    throw InputError(
        fmt::format("{}: the bodies have {} parts, where {} fit a scene; leave some out, or join "
                    "them",
                    description.file, count, rendering::kMaxBodyParts));
  }
}

std::vector<BakedPart> bake_parts(std::span<const PartDescription> descriptions,
                                  const std::string& object, const std::string& scene,
                                  std::vector<std::string>& warnings) {
  // A hull that leaves out less of its mesh has no warning, m.
  constexpr double kToldOfPart_m = 1e-5;
  std::vector<BakedPart> parts;
  for (const PartDescription& part : descriptions) {
    if (part.primitive) {
      parts.push_back({.primitive = part.primitive, .hull = {}});
      continue;
    }
    const std::string place =
        fmt::format("{}:{}: {} part {}", scene, part.line, object, parts.size() + 1);
    const ConvexHull hull = hull_of_part(part, place);
    if (hull.left_out_m > kToldOfPart_m) {
      warnings.push_back(fmt::format("part {} is a hull of {} vertices, which leaves out {:.2g} mm",
                                     parts.size() + 1, hull.vertices.size(),
                                     hull.left_out_m / kMillimetre_m));
    }
    parts.push_back({.primitive = std::nullopt, .hull = arrays_of(hull)});
  }
  return parts;
}

}  // namespace tactus::host
