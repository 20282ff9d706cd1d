// The meshes that the benchmark touches.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "host_tools/bake/scene/mesh_bake.h"
#include "rendering/objects/object.h"

namespace tactus::host {

struct BenchmarkMesh {
  std::string name;
  BakedMesh mesh;
};

// One-sided, 1000 N/m; friction 0.6 / 0.4 or none. Views the mesh, which must outlive it.
rendering::Object object_of(const BenchmarkMesh& mesh, bool friction);

// A fingertip's: 0.6 / 0.4, and for the models that have them a bristle of 800 N/m, damping that
// fades as early as keeps it passive, 0.05 s/m of viscosity, 10 mm/s of Stribeck velocity.
rendering::FrictionParameters fingertip_friction(rendering::FrictionKind kind);

// An icosphere of 0.1 m radius with 20 * 4^level triangles.
BenchmarkMesh sphere_mesh(int level);

// A mesh file, scaled to its longest side. Throws InputError.
BenchmarkMesh mesh_from_file(const std::string& name, const std::filesystem::path& file,
                             double longest_side_m);

// Debian's bunny; nothing if its package is not installed.
std::optional<BenchmarkMesh> bunny_mesh(double longest_side_m);

// The Stanford dragon at 0.2 m, out of the cache; nothing if it was never fetched.
std::optional<BenchmarkMesh> dragon_mesh_if_there();

// The same, fetched first if it is not there. Throws InputError.
BenchmarkMesh dragon_mesh();

}  // namespace tactus::host
