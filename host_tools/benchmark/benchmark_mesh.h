// The meshes that the benchmark touches, and the materials on them. `tactus bench` and the
// committed figures use them, so they do not change from run to run.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "host_tools/bake/scene/mesh_bake.h"
#include "rendering/objects/object.h"

namespace tactus::host {

// A mesh with its name in the figures.
struct BenchmarkMesh {
  std::string name;
  BakedMesh mesh;
};

// Returns a one-sided object of 1000 N/m with friction 0.6 / 0.4 (static / sliding) or none. It
// views `mesh`, which must outlive it.
rendering::Object object_of(const BenchmarkMesh& mesh, bool friction);

// Returns the friction of a fingertip, 0.6 / 0.4. Models with bristles get 800 N/m, 0.05 s/m of
// viscosity, a Stribeck velocity of 10 mm/s, and damping that fades early enough to be passive.
rendering::FrictionParameters fingertip_friction(rendering::FrictionKind kind);

// Returns an icosphere of 0.1 m radius with 20 * 4^level triangles.
BenchmarkMesh sphere_mesh(int level);

// Returns a mesh file, scaled to its longest side. Throws InputError.
BenchmarkMesh mesh_from_file(const std::string& name, const std::filesystem::path& file,
                             double longest_side_m);

// Returns the Stanford bunny of Debian's package; nothing if the package is not installed.
std::optional<BenchmarkMesh> bunny_mesh(double longest_side_m);

// Returns 1,000 balls of 3 to 5 mm radius, heaped in one mesh of 320,000 triangles (gravel.h).
BenchmarkMesh gravel_mesh();

// Returns the Stanford dragon, 0.2 m long, from the user's cache; nothing if it was never fetched.
std::optional<BenchmarkMesh> dragon_mesh_if_there();

// Returns the dragon, which it fetches first if the cache has none. Throws InputError.
BenchmarkMesh dragon_mesh();

}  // namespace tactus::host
