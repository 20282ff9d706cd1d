// Reads [[object.body.part]]: the convex parts by which a body meets others.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "host_tools/bake/scene/placement.h"
#include "host_tools/bake/toml/toml_section.h"
#include "rendering/surface/primitive.h"

namespace tactus::host {

// A part as its scene describes it, at its place in the frame of the scene.
struct PartDescription {
  // The line of the mesh or the primitive, for errors in it.
  std::size_t line = 0;
  // The convex primitive; nothing for the hull of a mesh.
  std::optional<rendering::Primitive> primitive;
  // The mesh file, resolved against the scene file's folder, and its place.
  std::filesystem::path mesh;
  Placement placement;
};

// Reads the parts of a body, whose object is at `placement`; none if there are none. Throws
// InputError with the file and the line for a part that is none, or more than kMaxPartsOfBody.
std::vector<PartDescription> read_parts(const TomlSection& body, const toml::table& table,
                                        std::string_view file, const std::filesystem::path& folder,
                                        const Placement& placement);

}  // namespace tactus::host
