#include "host_tools/bake/bake_json.h"

#include <nlohmann/json.hpp>

#include "host_tools/bake/device/certificate_file.h"
#include "host_tools/files/atomic_file.h"
#include "host_tools/files/output_place.h"

namespace tactus::host {
namespace {

std::string line_of(const nlohmann::ordered_json& json) {
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

nlohmann::ordered_json json_of_object(const ObjectReport& object) {
  return {{"name", object.name},
          {"mesh", object.mesh},
          {"triangles", object.triangles},
          {"vertices", object.vertices},
          {"dropped_triangles", object.counters.degenerate_triangles},
          {"welded_vertices", object.counters.welded_vertices},
          {"open_edges", object.counters.open_edges},
          {"non_manifold_edges", object.counters.non_manifold_edges},
          {"inconsistent_edges", object.counters.inconsistent_edges},
          {"lines_and_points", object.lines_and_points},
          {"bytes", object.bytes},
          {"bytes_per_triangle",
           static_cast<double>(object.bytes) / static_cast<double>(object.triangles)},
          {"seconds", object.seconds},
          {"warnings", object.warnings}};
}

}  // namespace

LoadedDevice bake_device_file(const std::filesystem::path& file,
                              const std::filesystem::path& image) {
  keep_inputs_safe({image}, {file, certificate_path(file)});
  LoadedDevice device = bake_device(file);
  write_file_atomically(image, device.image());
  return device;
}

std::string bake_json(const BakeReport& report) {
  nlohmann::ordered_json json{{"image", report.image},
                              {"tool_radius_m", report.tool_radius_m},
                              {"bytes", report.bytes},
                              {"seconds", report.seconds},
                              {"objects", nlohmann::ordered_json::array()}};
  for (const ObjectReport& object : report.objects) {
    json["objects"].push_back(json_of_object(object));
  }
  return line_of(json);
}

std::string bake_json(const LoadedDevice& device, const std::filesystem::path& image) {
  const firmware::DeviceConfig& config = device.config();
  return line_of({{"image", image.string()},
                  {"bytes", device.image().size()},
                  {"joints", config.joint_count},
                  {"axes", config.axis_count},
                  {"connections", config.connection_count},
                  {"rate_hz", config.controller.rate_hz},
                  {"certified", config.certification.limits.exists()}});
}

}  // namespace tactus::host
