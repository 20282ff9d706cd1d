#include "host_tools/benchmark/benchmark_mesh.h"

#include "host_tools/bake/mesh_file/mesh_import.h"
#include "host_tools/bake/scene/placement.h"
#include "host_tools/benchmark/debian_bunny.h"
#include "host_tools/benchmark/gravel.h"
#include "host_tools/benchmark/stanford_dragon.h"
#include "host_tools/files/private_folder.h"
#include "host_tools/mesh/icosphere.h"
#include "rendering/friction/lugre_passivity.h"

namespace tactus::host {
namespace {

// The sizes of the meshes, which the help text of `tactus bench` names.
constexpr double kSphereRadius_m = 0.1;
constexpr double kDragonSide_m = 0.2;

}  // namespace

rendering::FrictionParameters fingertip_friction(rendering::FrictionKind kind) {
  rendering::FrictionParameters friction = rendering::cone_friction(0.6, 0.4);
  friction.kind = kind;
  friction.viscous_s_per_m = 0.05;
  friction.stribeck_velocity_m_per_s = 0.01;
  if (rendering::has_bristles(kind)) {
    friction.stiffness_N_per_m = 800.0;
    friction.damping_s_per_m = 2.0;
  }
  if (rendering::has_bristles(kind) && rendering::is_damped(kind)) {
    friction.damping_fade_m_per_s = rendering::lugre_passivity(friction).largest_fade_m_per_s;
  }
  return friction;
}

rendering::Object object_of(const BenchmarkMesh& mesh, bool friction) {
  const auto rough = fingertip_friction(rendering::FrictionKind::cone);
  return {.mesh = mesh.mesh.view(),
          .sides = rendering::Sides::one,
          .material = {.stiffness_N_per_m = 1000.0,
                       .friction = friction ? rough : rendering::FrictionParameters{}}};
}

BenchmarkMesh sphere_mesh(int level) {
  return {.name = "sphere", .mesh = bake_mesh(icosphere(kSphereRadius_m, level))};
}

BenchmarkMesh mesh_from_file(const std::string& name, const std::filesystem::path& file,
                             double longest_side_m) {
  ImportedMesh imported = import_mesh(file);
  const Placement placement{.longest_side_m = longest_side_m};
  return {.name = name, .mesh = bake_mesh(place(imported, placement))};
}

std::optional<BenchmarkMesh> bunny_mesh(double longest_side_m) {
  const PrivateFolder folder;
  const auto file = extract_debian_bunny(folder.path());
  if (!file) {
    return std::nullopt;
  }
  return mesh_from_file("bunny", *file, longest_side_m);
}

BenchmarkMesh gravel_mesh() {
  return {.name = "gravel", .mesh = bake_mesh(gravel())};
}

std::optional<BenchmarkMesh> dragon_mesh_if_there() {
  const std::filesystem::path file = stanford_dragon_file();
  if (!std::filesystem::exists(file)) {
    return std::nullopt;
  }
  return mesh_from_file("dragon", file, kDragonSide_m);
}

BenchmarkMesh dragon_mesh() {
  return mesh_from_file("dragon", fetch_stanford_dragon(), kDragonSide_m);
}

}  // namespace tactus::host
