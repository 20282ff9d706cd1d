#include "host_tools/bake/scene/object_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string_view>

#include "host_tools/bake/formula/formula_mesh.h"
#include "host_tools/bake/formula/formula_warnings.h"
#include "host_tools/bake/formula/pole_search.h"
#include "host_tools/bake/mesh_file/mesh_import.h"
#include "host_tools/bake/scene/closed_volume.h"
#include "host_tools/bake/scene/open_loops.h"
#include "host_tools/bake/scene/size_check.h"
#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

// Returns the name of an object's mesh for messages: that of its file, or of the object if the mesh
// is made from a formula.
std::string name_of_mesh(const ObjectDescription& object) {
  return object.mesh.empty() ? object.name : object.mesh.string();
}

// Makes the mesh of a formula that has no poles.
ImportedMesh make_mesh(const ObjectDescription& object, const ImplicitDescription& implicit,
                       const std::string& scene, const Progress& progress) {
  const FormulaMeshPlan plan{.tolerance_m = implicit.tolerance_m,
                             .unit_m = object.placement.scale,
                             .progress = [&](std::size_t triangles) {
                               tell(progress, fmt::format("{}: {} triangles, not near enough yet",
                                                          object.name, triangles));
                             }};
  std::vector<std::string> warnings = check_formula(object, scene);
  try {
    ImportedMesh mesh = mesh_formula(implicit.formula.view(), implicit.bounds_O, plan);
    for (std::string& note : mesh.notes) {
      note.insert(0, object.name + ": ");
    }
    std::ranges::move(warnings, std::back_inserter(mesh.notes));
    return mesh;
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}:{}: {}", scene, object.line, error.what()));
  }
}

}  // namespace

bool is_touched_as_mesh(const ObjectDescription& object) {
  return !object.mesh.empty() || meshed_formula(object.shape, object.contact) != nullptr;
}

ImportedMesh mesh_of(const ObjectDescription& object, const std::string& scene,
                     const Progress& progress) {
  if (const auto* implicit = meshed_formula(object.shape, object.contact)) {
    tell(progress, fmt::format("{}: cutting the formula into triangles", object.name));
    return make_mesh(object, *implicit, scene, progress);
  }
  tell(progress, fmt::format("{}: reading {}", object.name, object.mesh.string()));
  ImportedMesh imported = import_mesh(object.mesh);
  if (object.flip) {
    turn_inside_out(imported);
  }
  return imported;
}

BakedMesh bake_mesh_of(const ObjectDescription& object, const ImportedMesh& imported) {
  try {
    return bake_mesh(place(imported, object.placement), object.mesh_options);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", name_of_mesh(object), error.what()));
  }
}

// Returns the end of a sentence that tells where the holes of a mesh are and what closes them;
// nothing if it has none.
std::string advice_on_holes(const ObjectDescription& object, const BakedMesh& mesh) {
  const std::vector<OpenLoop> loops = find_open_loops(mesh.vertices, mesh.triangles);
  if (loops.empty()) {
    return "";
  }
  const std::string text = text_of_loops(loops);
  return object.mesh.empty()
             ? fmt::format(". {}", text)
             : fmt::format(". {}; cap_holes_mm = {:.3g} would close {}", text,
                           cap_holes_mm_for(loops), loops.size() == 1 ? "it" : "all");
}

// A one-sided surface with holes lets the tool get behind it, where it feels nothing.
std::vector<std::string> mesh_warnings(const ObjectDescription& object,
                                       const ImportedMesh& imported, const BakedMesh& mesh) {
  const rendering::BakeCounters& counters = mesh.counters;
  std::vector<std::string> warnings = imported.notes;
  if (object.sides == rendering::Sides::one &&
      (counters.open_edges != 0 || counters.non_manifold_edges != 0 ||
       counters.inconsistent_edges != 0)) {
    warnings.push_back(fmt::format(
        "{}: the mesh has {} open, {} non-manifold and {} inconsistently wound edges, so the tool "
        "can get behind it; write sides = \"two\", or close the mesh{}",
        name_of_mesh(object), counters.open_edges, counters.non_manifold_edges,
        counters.inconsistent_edges, advice_on_holes(object, mesh)));
  }
  if (mesh.caps.holes != 0) {
    warnings.push_back(fmt::format("{}: {} hole{} closed by {} triangles", name_of_mesh(object),
                                   mesh.caps.holes, mesh.caps.holes == 1 ? " is" : "s are",
                                   mesh.caps.triangles));
  }
  if (counters.degenerate_triangles != 0) {
    warnings.push_back(fmt::format("{}: {} triangles without area are left out",
                                   name_of_mesh(object), counters.degenerate_triangles));
  }
  const std::string_view remedy =
      object.flip ? "leave flip = true out" : "write flip = true at the object";
  if (const auto warning = inside_out_warning(closed_volume(mesh.baked_view()), remedy)) {
    warnings.push_back(fmt::format("{}: {}", name_of_mesh(object), *warning));
  }
  std::ranges::move(size_warnings(object, mesh), std::back_inserter(warnings));
  return warnings;
}

std::vector<std::string> check_formula(const ObjectDescription& object, const std::string& scene) {
  const auto* implicit = std::get_if<ImplicitDescription>(&object.shape);
  if (implicit == nullptr) {
    return {};
  }
  const rendering::FormulaView formula = implicit->formula.view();
  if (const auto pole = find_pole(formula, implicit->bounds_O, object.sides)) {
    throw InputError(fmt::format(
        "{}:{}: the formula has a pole at about {}, in its own units, or comes so near to one that "
        "the proxy could be held there; multiply the formula by what it divides by there (1/x - y "
        "becomes 1 - x*y), or choose "
        "bounds that leave the place out",
        scene, object.line, place_text(*pole, implicit->bounds_O)));
  }
  std::vector<std::string> warnings = formula_warnings(formula, implicit->bounds_O, object.sides);
  for (std::string& warning : warnings) {
    warning.insert(0, object.name + ": ");
  }
  return warnings;
}

}  // namespace tactus::host
