#include "host_tools/bake/scene/size_check.h"

#include <fmt/format.h>

#include <algorithm>

#include "host_tools/units.h"
#include "rendering/limits.h"

namespace tactus::host {
namespace {

// The longest mesh that is taken for one in millimetres.
constexpr double kLongestInMillimetres_m = 2000.0;

// Returns the line to write for a mesh that is `side` metres long.
std::string size_remedy(const Placement& placement, double side) {
  const double in_millimetres = kMillimetre_m * side;
  const bool may_be_millimetres = side > kLongestObject_m && side <= kLongestInMillimetres_m;
  if (may_be_millimetres && placement.longest_side_m) {
    return fmt::format("that looks like millimetres: write longest_side_m = {:.6g}",
                       in_millimetres);
  }
  if (may_be_millimetres) {
    return fmt::format(
        "its file looks like millimetres: write scale = {:.6g}, which makes it {:.4g} m",
        kMillimetre_m * placement.scale, in_millimetres);
  }
  return "write longest_side_m = 0.1, or the right scale";
}

}  // namespace

std::vector<std::string> size_warnings(const ObjectDescription& object, const BakedMesh& mesh) {
  std::vector<std::string> warnings;
  const bool is_mesh = !object.mesh.empty();
  const std::string name = is_mesh ? object.mesh.string() : object.name;
  const Vec3 low = rendering::to_vec3(mesh.nodes.front().lower);
  const Vec3 high = rendering::to_vec3(mesh.nodes.front().upper);
  const double side = (high - low).maxCoeff();
  if (is_mesh && (side > kLongestObject_m || side < kShortestObject_m)) {
    warnings.push_back(fmt::format("{}: the object is {:.4g} m long; {}", name, side,
                                   size_remedy(object.placement, side)));
  }
  const double reach = std::max(low.cwiseAbs().maxCoeff(), high.cwiseAbs().maxCoeff());
  const bool is_off_centre = reach > side;
  if (reach > rendering::kWorldBound_m && (is_off_centre || !is_mesh)) {
    warnings.push_back(fmt::format(
        "{}: the object reaches {:.6g} m from the world's origin, where the world ends at {} m; "
        "correct position_m{}",
        name, reach, rendering::kWorldBound_m,
        is_mesh && !object.placement.longest_side_m
            ? ", or write longest_side_m, which centres the mesh"
            : ""));
  }
  return warnings;
}

}  // namespace tactus::host
