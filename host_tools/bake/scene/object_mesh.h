// Gets the mesh of an object from its file or from its formula, bakes it, and finds what is odd
// about it.
#pragma once

#include <string>
#include <vector>

#include "host_tools/bake/mesh_file/polygon_mesh.h"
#include "host_tools/bake/scene/mesh_bake.h"
#include "host_tools/bake/scene/progress.h"
#include "host_tools/bake/scene/scene_description.h"

namespace tactus::host {

// Returns true if the controller touches the object as a mesh: it has a mesh file, or a formula
// with a contact for meshes.
bool is_touched_as_mesh(const ObjectDescription& object);

// Returns the mesh of such an object in the frame and the unit of its file or formula. Throws
// InputError that names the file, or the line of the scene for a formula. `scene` is its name.
ImportedMesh mesh_of(const ObjectDescription& object, const std::string& scene,
                     const Progress& progress);

// Places and bakes that mesh. Throws InputError that names the mesh.
BakedMesh bake_mesh_of(const ObjectDescription& object, const ImportedMesh& imported);

// Returns the notes of the import and the findings about the baked mesh, one line each.
std::vector<std::string> mesh_warnings(const ObjectDescription& object,
                                       const ImportedMesh& imported, const BakedMesh& mesh);

// Returns warnings about an object's formula; none for other shapes. Throws InputError if the
// formula has a pole that the proxy could reach.
std::vector<std::string> check_formula(const ObjectDescription& object, const std::string& scene);

}  // namespace tactus::host
