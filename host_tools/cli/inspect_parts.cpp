#include "host_tools/cli/inspect_parts.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string>

#include "rendering/surface/primitive.h"

namespace tactus::host {
namespace {

// Returns the name of the primitive, or "hull".
std::string kind_of(const rendering::BodyPart& part) {
  return part.hull.vertices_O.empty()
             ? std::string(
                   rendering::kPrimitives.at(static_cast<std::size_t>(part.primitive.kind)).name)
             : "hull";
}

rendering::Bounds box_of(const rendering::BodyPart& part) {
  if (part.hull.vertices_O.empty()) {
    return rendering::bounds(part.primitive);
  }
  rendering::Bounds box{part.hull.vertices_O.front(), part.hull.vertices_O.front()};
  for (const Vec3& vertex : part.hull.vertices_O) {
    box.lower_W = box.lower_W.cwiseMin(vertex);
    box.upper_W = box.upper_W.cwiseMax(vertex);
  }
  return box;
}

}  // namespace

std::vector<rendering::BodyPart> parts_of(const rendering::SceneImage& image, std::size_t object) {
  const std::uint8_t number = image.objects()[object].body;
  if (number == rendering::kNoBody) {
    return {};
  }
  const rendering::ObjectBody& body = image.bodies()[number];
  const auto parts = image.body_parts().subspan(body.first_part, body.part_count);
  return {parts.begin(), parts.end()};
}

nlohmann::ordered_json json_of_parts(const std::vector<rendering::BodyPart>& parts) {
  auto json = nlohmann::ordered_json::array();
  for (const rendering::BodyPart& part : parts) {
    const rendering::Bounds box = box_of(part);
    json.push_back({{"kind", kind_of(part)},
                    {"vertices", part.hull.vertices_O.size()},
                    {"box_lower_m", {box.lower_W.x(), box.lower_W.y(), box.lower_W.z()}},
                    {"box_upper_m", {box.upper_W.x(), box.upper_W.y(), box.upper_W.z()}}});
  }
  return json;
}

void print_parts(const std::vector<rendering::BodyPart>& parts) {
  std::size_t number = 0;
  for (const rendering::BodyPart& part : parts) {
    const rendering::Bounds box = box_of(part);
    const std::string vertices = part.hull.vertices_O.empty()
                                     ? ""
                                     : fmt::format(" of {} vertices", part.hull.vertices_O.size());
    fmt::print("  part {:<6}{}{}, ({:.6g}, {:.6g}, {:.6g}) to ({:.6g}, {:.6g}, {:.6g}) m\n",
               ++number, kind_of(part), vertices, box.lower_W.x(), box.lower_W.y(), box.lower_W.z(),
               box.upper_W.x(), box.upper_W.y(), box.upper_W.z());
  }
}

}  // namespace tactus::host
