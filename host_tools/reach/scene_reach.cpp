#include "host_tools/reach/scene_reach.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "host_tools/simulation/grid_share.h"

namespace tactus::host {
namespace {

// Objects are larger than this only if they have no end, like a plane; what is near counts of them.
constexpr double kEndless_m = 1.0;
// An object is in reach if at least this share of its box is.
constexpr double kInReach = 0.5;

double share_of_box(const ReachMap& map, const ReachBox& box) {
  constexpr int kSide = 7;
  int reached = 0;
  for (int i = 0; i < kSide * kSide * kSide; ++i) {
    const Vec3 p_B = box.lower_B + grid_share(i, kSide).cwiseProduct(box.upper_B - box.lower_B);
    reached += map.at(p_B) ? 1 : 0;
  }
  return static_cast<double>(reached) / (kSide * kSide * kSide);
}

}  // namespace

std::vector<ObjectReach> reach_of_objects(const ReachMap& map,
                                          std::span<const rendering::Object> objects,
                                          std::span<const std::string_view> names) {
  const Vec3 origin_B = map.config().controller.workspace_origin_D;
  std::vector<ObjectReach> reaches;
  reaches.reserve(objects.size());
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const rendering::Bounds bounds = rendering::bounds_of(objects[i]);
    const Vec3 endless = Vec3::Constant(kEndless_m);
    ObjectReach reach{.name = i < names.size() && !names[i].empty() ? std::string(names[i])
                                                                    : fmt::format("object {}", i),
                      .box_B = {}};
    reach.box_B.include(bounds.lower_W.cwiseMax(-endless) + origin_B);
    reach.box_B.include(bounds.upper_W.cwiseMin(endless) + origin_B);
    reach.reached_share = share_of_box(map, reach.box_B);
    reaches.push_back(std::move(reach));
  }
  return reaches;
}

Vec3 centred_origin(const ReachMap& map, std::span<const ObjectReach> objects) {
  ReachBox whole;
  for (const ObjectReach& object : objects) {
    whole.include(object.box_B.lower_B);
    whole.include(object.box_B.upper_B);
  }
  const Vec3 origin_B = map.config().controller.workspace_origin_D;
  return whole.is_empty()
             ? origin_B
             : Vec3(origin_B + map.device().centre_B - 0.5 * (whole.lower_B + whole.upper_B));
}

std::string scene_reach_text(const ReachMap& map, std::span<const ObjectReach> objects) {
  std::string text;
  for (const ObjectReach& object : objects) {
    fmt::format_to(std::back_inserter(text), "'{}': the handle reaches {:.0f} % of its box\n",
                   object.name, 100.0 * object.reached_share);
  }
  const bool is_far = std::ranges::any_of(
      objects, [](const ObjectReach& object) { return object.reached_share < kInReach; });
  if (is_far) {
    const Vec3 origin = centred_origin(map, objects);
    fmt::format_to(std::back_inserter(text),
                   "to put the middle of the scene into the middle of the workspace: [controller] "
                   "workspace_origin_m = [{:.4g}, {:.4g}, {:.4g}]\n",
                   origin.x(), origin.y(), origin.z());
  }
  return text;
}

}  // namespace tactus::host
