#include "host_tools/foxglove/scene_messages.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <numbers>
#include <string_view>

#include "host_tools/foxglove/json_parts.h"

namespace tactus::host {
namespace {

using rendering::Object;

// Colours that colour-blind people can tell apart (Okabe and Ito, "Color Universal Design", 2008).
// The first one is pale, for the scene of one object.
constexpr std::array<std::array<double, 3>, 8> kObjectColours = {{{0.80, 0.78, 0.74},
                                                                  {0.34, 0.71, 0.91},
                                                                  {0.90, 0.62, 0.00},
                                                                  {0.00, 0.62, 0.45},
                                                                  {0.94, 0.89, 0.26},
                                                                  {0.80, 0.47, 0.65},
                                                                  {0.00, 0.45, 0.70},
                                                                  {0.84, 0.37, 0.00}}};
// A layer that a needle pierces lets the needle be seen.
constexpr double kTissueOpacity = 0.4;

std::string_view kind_of_surface(const Object& object) {
  switch (object.surface) {
    case rendering::SurfaceKind::mesh:
      return "mesh";
    case rendering::SurfaceKind::primitive:
      return "primitive";
    default:
      return "formula";
  }
}

void append_points(fmt::memory_buffer& text, const rendering::MeshView& mesh) {
  const auto out = std::back_inserter(text);
  std::string_view separator;
  for (const rendering::Float3& p : mesh.vertices) {
    fmt::format_to(out, R"({}{{"x":{},"y":{},"z":{}}})", separator, p.x, p.y, p.z);
    separator = ",";
  }
}

void append_indices(fmt::memory_buffer& text, const rendering::MeshView& mesh) {
  const auto out = std::back_inserter(text);
  std::string_view separator;
  for (const rendering::TriangleIndices& triangle : mesh.triangles) {
    fmt::format_to(out, "{}{},{},{}", separator, triangle[0], triangle[1], triangle[2]);
    separator = ",";
  }
}

void append_object(fmt::memory_buffer& text, const rendering::SceneImage& scene, std::size_t index,
                   std::uint64_t time_ns) {
  const Object& object = scene.objects()[index];
  const auto& colour = kObjectColours[index % kObjectColours.size()];
  const auto out = std::back_inserter(text);
  fmt::format_to(
      out,
      R"({{"timestamp":{},"frame_id":{},"id":{},"lifetime":{{"sec":0,"nsec":0}},"frame_locked":true,)"
      R"("metadata":[{{"key":"name","value":{}}},{{"key":"surface","value":"{}"}}],)"
      R"("arrows":[],"cubes":[],"spheres":[],"cylinders":[],"lines":[],"triangles":[{{"pose":{},)"
      R"("color":{{"r":{},"g":{},"b":{},"a":{}}},"colors":[],"points":[)",
      time_json(time_ns), text_json(object_frame(scene, index)),
      text_json(fmt::format("object/{}", index)), text_json(scene.object_name(index)),
      kind_of_surface(object), pose_json({}, kUnturned), colour[0], colour[1], colour[2],
      rendering::is_tissue(object) ? kTissueOpacity : 1.0);
  append_points(text, object.mesh);
  fmt::format_to(out, R"(],"indices":[)");
  append_indices(text, object.mesh);
  fmt::format_to(out, R"(]}}],"texts":[],"models":[]}})");
}

// Begins a SceneUpdate that removes what earlier ones have shown; its entities follow.
std::string deletion_of_all(std::uint64_t time_ns) {
  constexpr int kAll = 1;
  return fmt::format(R"({{"deletions":[{{"timestamp":{},"type":{},"id":""}}],"entities":[)",
                     time_json(time_ns), kAll);
}

std::string transform_json(std::string_view parent, std::string_view child,
                           const firmware::Triple& translation, const firmware::Quadruple& rotation,
                           std::uint64_t time_ns) {
  return fmt::format(
      R"({{"timestamp":{},"parent_frame_id":{},"child_frame_id":{},"translation":{},"rotation":{}}})",
      time_json(time_ns), text_json(parent), text_json(child), vector_json(translation),
      rotation_json(rotation));
}

// The world's y is up and its z comes toward the user; in the upright frame z is up and y leads
// away. This turns by a quarter about x.
constexpr firmware::Quadruple kUprightRotation = {std::numbers::sqrt2 / 2.0,
                                                  std::numbers::sqrt2 / 2.0, 0.0, 0.0};

}  // namespace

std::string object_frame(const rendering::SceneImage& scene, std::size_t object) {
  return scene.objects()[object].moves ? fmt::format("object/{}", object)
                                       : std::string(kWorldFrame);
}

std::string scene_message(const rendering::SceneImage& scene, std::uint64_t time_ns) {
  fmt::memory_buffer text;
  fmt::format_to(std::back_inserter(text), "{}", deletion_of_all(time_ns));
  std::string_view separator;
  for (std::size_t i = 0; i < scene.objects().size(); ++i) {
    fmt::format_to(std::back_inserter(text), "{}", separator);
    // A removal must be earlier than the entities that take the place.
    append_object(text, scene, i, time_ns + 1);
    separator = ",";
  }
  fmt::format_to(std::back_inserter(text), "]}}");
  return fmt::to_string(text);
}

std::string empty_scene_message(std::uint64_t time_ns) {
  return deletion_of_all(time_ns) + "]}";
}

std::string frames_message(const rendering::SceneImage* scene, const TimedPlaces& timed,
                           std::uint64_t time_ns) {
  std::string text = R"({"transforms":[)";
  text += transform_json(kUprightFrame, kWorldFrame, {}, kUprightRotation, time_ns);
  const std::size_t objects = scene == nullptr ? 0 : scene->objects().size();
  for (std::size_t i = 0; i < objects; ++i) {
    if (!scene->objects()[i].moves) {
      continue;
    }
    const auto place = std::ranges::find(timed.places, i, &firmware::ObjectPlace::object);
    const bool is_known = place != timed.places.end();
    const firmware::ObjectPlace shown = is_known ? *place : firmware::ObjectPlace{};
    text += ',';
    text += transform_json(kWorldFrame, object_frame(*scene, i), shown.origin_W, shown.rotation_W,
                           is_known ? timed.time_ns : time_ns);
  }
  text += "]}";
  return text;
}

}  // namespace tactus::host
