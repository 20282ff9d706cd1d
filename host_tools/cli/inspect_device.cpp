#include "host_tools/cli/inspect_device.h"

#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "firmware/device_file/bus_load.h"
#include "firmware/device_file/device_image.h"
#include "host_tools/bake/device/device_bake.h"
#include "host_tools/bake/scene/mapped_scene.h"
#include "host_tools/files/output_place.h"
#include "host_tools/reach/reach_figure.h"
#include "host_tools/reach/reach_summary.h"
#include "host_tools/reach/scene_reach.h"

namespace tactus::host {
namespace {

// A device with everything that is printed of it.
struct InspectedDevice {
  const LoadedDevice& loaded;
  const ReachMap& map;
  ReachSummary summary;
  std::vector<std::string> warnings;
  std::vector<ObjectReach> objects;
};

std::vector<ObjectReach> objects_of(const ReachMap& map, const std::string& file) {
  if (file.empty()) {
    return {};
  }
  const MappedScene scene(file);
  std::vector<std::string_view> names;
  for (std::size_t i = 0; i < scene.image().objects().size(); ++i) {
    names.push_back(scene.image().object_name(i));
  }
  return reach_of_objects(map, scene.image().objects(), names);
}

void print_device_text(const InspectDeviceOptions& options, const InspectedDevice& device) {
  const firmware::DeviceConfig& config = device.loaded.config();
  fmt::print("{}: {}{}{}, {}\n", options.device, config.name, config.name.empty() ? "" : ", ",
             config.preset, in_words(config));
  for (std::size_t i = 0; i < config.joint_count; ++i) {
    const drivers::Transmission& t = config.joints[i].transmission;
    fmt::print("  {}: motor {:.4g}:1, encoder {:.4g}:1, one count {:.3g} {}\n",
               config.joints[i].name, t.motor_ratio, t.encoder_ratio,
               1e3 * device.map.resolution(i),
               firmware::slides(config.controller.mechanism) ? "mm" : "mrad");
  }
  fmt::print("{}{}", reach_text(device.map, device.summary),
             scene_reach_text(device.map, device.objects));
  for (const std::string& warning : device.warnings) {
    fmt::print(stderr, "tactus inspect: warning: {}\n", warning);
  }
}

nlohmann::ordered_json vector_json(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

void print_device_json(const InspectDeviceOptions& options, const InspectedDevice& device) {
  const firmware::DeviceConfig& config = device.loaded.config();
  const ReachSummary& s = device.summary;
  const PlantParameters& plant = device.map.device().device.plant;
  nlohmann::ordered_json json{
      {"device", options.device},
      {"name", config.name},
      {"mechanism", config.preset},
      {"rate_hz", config.controller.rate_hz},
      {"moving_mass_kg", plant.moving_mass_kg},
      {"workspace_lower_m", vector_json(plant.stop_lower_B)},
      {"workspace_upper_m", vector_json(plant.stop_upper_B)},
      {"resolution_m",
       {{"finest", s.finest_m}, {"middle", s.middle.resolution_m}, {"coarsest", s.coarsest_m}}},
      {"force_N",
       {{"weakest", s.weakest_N}, {"middle", s.middle.force_N}, {"strongest", s.strongest_N}}},
      {"joints", nlohmann::ordered_json::array()},
      {"buses", nlohmann::ordered_json::array()},
      {"certified", config.certification.limits.exists()},
      {"warnings", device.warnings}};
  for (std::size_t i = 0; i < config.joint_count; ++i) {
    json["joints"].push_back({{"name", config.joints[i].name},
                              {"motor_ratio", config.joints[i].transmission.motor_ratio},
                              {"encoder_ratio", config.joints[i].transmission.encoder_ratio},
                              {"effort", device.map.effort(i)},
                              {"count", device.map.resolution(i)},
                              {"weight_share", s.weight_share[i]}});
  }
  for (std::size_t i = 0; i < config.connection_count; ++i) {
    json["buses"].push_back(
        {{"name", config.connections[i].name}, {"load", firmware::bus_load(config, i)}});
  }
  for (const ObjectReach& object : device.objects) {
    json["objects"].push_back({{"name", object.name}, {"reached_share", object.reached_share}});
  }
  fmt::print("{}\n", json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

void draw_device(const InspectDeviceOptions& options, const InspectedDevice& device) {
  keep_inputs_safe({options.picture}, {options.device, options.scene});
  const std::string name(device.loaded.config().name);
  const ReachSummary& s = device.summary;
  draw_reach(
      device.map, device.objects,
      fmt::format("The reach of {}", name.empty() ? "this device" : name),
      fmt::format("in the workspace: one count {:.0f} to {:.0f} µm, force {:.1f} to {:.1f} N; "
                  "cuts through its middle",
                  1e6 * s.finest_m, 1e6 * s.coarsest_m, s.weakest_N, s.strongest_N),
      options.picture);
}

}  // namespace

bool is_device_file(const std::string& file) {
  if (std::filesystem::path(file).extension() == ".toml") {
    return describes_device(file);
  }
  std::array<char, firmware::kDeviceMagic.size()> head{};
  std::ifstream(file, std::ios::binary).read(head.data(), head.size());
  return head == firmware::kDeviceMagic;
}

void inspect_device(const InspectDeviceOptions& options) {
  const LoadedDevice loaded = load_device(options.device);
  const ReachMap map(loaded.config());
  InspectedDevice device{.loaded = loaded,
                         .map = map,
                         .summary = summarise_reach(map),
                         .warnings = loaded.warnings(),
                         .objects = objects_of(map, options.scene)};
  for (std::string& warning : reach_warnings(map, device.summary)) {
    device.warnings.push_back(std::move(warning));
  }
  if (!options.picture.empty()) {
    draw_device(options, device);
  }
  if (options.json) {
    print_device_json(options, device);
  } else {
    print_device_text(options, device);
  }
}

}  // namespace tactus::host
