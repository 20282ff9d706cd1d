#include "host_tools/cli/inspect_profiles.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace tactus::host {
namespace {

std::vector<rendering::ExceededCapacity> all_exceeded(const rendering::SceneCounts& counts,
                                                      const rendering::CapacityProfile& profile) {
  std::vector<rendering::ExceededCapacity> all;
  for (const rendering::SceneCapacity& capacity : rendering::kSceneCapacities) {
    if (const auto found = rendering::exceeded(capacity, counts, profile)) {
      all.push_back(*found);
    }
  }
  return all;
}

}  // namespace

nlohmann::ordered_json json_of_profiles(const rendering::SceneCounts& counts,
                                        std::span<const rendering::CapacityProfile> profiles) {
  auto json = nlohmann::ordered_json::array();
  for (const rendering::CapacityProfile& profile : profiles) {
    auto exceeded = nlohmann::ordered_json::array();
    for (const rendering::ExceededCapacity& capacity : all_exceeded(counts, profile)) {
      exceeded.push_back(
          {{"capacity", capacity.name}, {"count", capacity.count}, {"limit", capacity.limit}});
    }
    json.push_back({{"name", profile.name}, {"fits", exceeded.empty()}, {"exceeded", exceeded}});
  }
  return json;
}

void print_profiles(const rendering::SceneCounts& counts,
                    std::span<const rendering::CapacityProfile> profiles) {
  fmt::print("\nprofiles of the controller that have room for the scene\n");
  for (const rendering::CapacityProfile& profile : profiles) {
    std::string missing;
    for (const rendering::ExceededCapacity& capacity : all_exceeded(counts, profile)) {
      missing +=
          fmt::format("{} {} {}, where {} fit{}", missing.empty() ? "," : ";", capacity.count,
                      capacity.noun, capacity.limit, capacity.limit == 1 ? "s" : "");
    }
    fmt::print("  {:<16} {}{}\n", fmt::format("{}:", profile.name), missing.empty() ? "yes" : "no",
               missing);
  }
}

}  // namespace tactus::host
