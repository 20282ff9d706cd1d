#include "host_tools/cli/inspect_verb.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <ranges>
#include <string>
#include <string_view>
#include <vector>

#include "host_tools/bake/scene/closed_volume.h"
#include "host_tools/bake/scene/friction_description.h"
#include "host_tools/bake/scene/mapped_scene.h"
#include "host_tools/bake/scene/open_loops.h"
#include "host_tools/cli/inspect_device.h"
#include "host_tools/cli/inspect_graph.h"
#include "host_tools/cli/inspect_holes.h"
#include "host_tools/cli/inspect_parts.h"
#include "host_tools/cli/inspect_profiles.h"
#include "host_tools/cli/picture_option.h"
#include "host_tools/files/output_place.h"
#include "host_tools/input_error.h"
#include "host_tools/units.h"
#include "rendering/profiles/chosen_profile.h"
#include "rendering/scene/scene_world.h"

namespace tactus::host {
namespace {

using rendering::Float3;
using rendering::SceneImage;

constexpr const char* kInspectExamples =
    "An image that opens has passed every check: checksum, structure, index ranges, hierarchy.\n"
    "\n"
    "The controller has room for a scene in the profiles that are listed with yes; a build chooses "
    "one with TACTUS_PROFILE.\n"
    "\n"
    "A hole is a loop of open edges; its size is the diameter of a ball that holds it.\n"
    "\n"
    "Examples:\n"
    "  tactus inspect scene.tactus\n"
    "  tactus inspect scene.tactus --picture holes.png     marks the holes of its meshes\n"
    "  tactus inspect scene.tactus --json | jq '.objects[] | {name, triangles}'\n"
    "  tactus inspect scene.tactus --json | jq '.profiles[] | select(.fits).name'\n"
    "  tactus inspect arm.tactus --figure reach.png        what a device reaches, how finely and "
    "how strongly\n"
    "  tactus inspect arm.toml --scene scene.tactus        whether it reaches that scene\n"
    "  tactus inspect --graph stone.off                    the connection graph of a mesh, by "
    "type\n"
    "  tactus inspect --graph scene.tactus --picture g.png the graph drawn over the meshes\n"
    "  tactus inspect --graph stone.off --dot g.dot        then dot -Tsvg g.dot -o g.svg\n"
    "  tactus inspect --graph stone.off --json | jq '.meshes[0].connections[0]'";

// The verb's options as the user gave them.
struct InspectOptions {
  std::string image;
  std::string picture;
  std::string scene;
  bool json = false;
  InspectGraphOptions graph;
};

// The image's data about one object, gathered from its views.
struct ObjectSummary {
  std::string name;
  rendering::Object object;
  rendering::BakeCounters counters;
  double bytes_per_triangle;
  // Nothing unless the surface is a closed mesh.
  std::optional<ClosedVolume> volume;
  // The holes of a mesh; none of another surface.
  std::vector<OpenLoop> holes;
  // The convex parts of its body.
  std::vector<rendering::BodyPart> parts;

  // The corners of the object's box, world frame, m: the root of the hierarchy has them.
  [[nodiscard]] const Float3& lower() const { return object.mesh.nodes.front().lower; }
  [[nodiscard]] const Float3& upper() const { return object.mesh.nodes.front().upper; }
  // Returns the name of the contact method.
  [[nodiscard]] std::string_view contact() const {
    return rendering::kContactMethods.at(static_cast<std::size_t>(object.method)).name;
  }
  [[nodiscard]] const char* sides() const {
    return object.sides == rendering::Sides::one ? "one" : "two";
  }
};

// Returns the summary of one object.
ObjectSummary summarise(const SceneImage& image, std::size_t index) {
  const rendering::BakedMeshView baked = image.baked_mesh(index);
  const std::size_t bytes = baked.mesh.vertices.size_bytes() + baked.mesh.triangles.size_bytes() +
                            baked.mesh.nodes.size_bytes() + baked.neighbours.size_bytes() +
                            baked.vertex_normals.size_bytes();
  return {.name = std::string(image.object_name(index)),
          .object = image.objects()[index],
          .counters = image.counters(index),
          .bytes_per_triangle =
              static_cast<double>(bytes) / static_cast<double>(baked.mesh.triangles.size()),
          .volume = image.objects()[index].surface == rendering::SurfaceKind::mesh
                        ? closed_volume(baked)
                        : std::nullopt,
          .holes = holes_of(image, index),
          .parts = parts_of(image, index)};
}

nlohmann::ordered_json to_json(const Float3& v) {
  return nlohmann::ordered_json::array({v.x, v.y, v.z});
}

// Returns the friction as JSON, with the keys of a scene file.
nlohmann::ordered_json to_json(const rendering::FrictionParameters& friction) {
  nlohmann::ordered_json json{{"model", model_of(friction.kind).name}};
  for (const FrictionParameterName& name : surface_parameters(friction.kind)) {
    json[std::string(name.surface_key)] = friction.*name.member;
  }
  return json;
}

nlohmann::ordered_json to_json(const rendering::MaterialGrain& grain) {
  return {
      {"direction", to_json(grain.direction_O)}, {"along", grain.along}, {"across", grain.across}};
}

nlohmann::ordered_json to_json(const std::vector<OpenLoop>& holes) {
  auto json = nlohmann::ordered_json::array();
  for (const OpenLoop& hole : holes) {
    json.push_back({{"size_m", hole.size_m},
                    {"middle_m", {hole.middle_W.x(), hole.middle_W.y(), hole.middle_W.z()}},
                    {"edges", hole.corners.size()},
                    {"is_loop", hole.is_closed}});
  }
  return json;
}

nlohmann::ordered_json to_json(const ObjectSummary& s) {
  const rendering::Material& material = s.object.material;
  return {{"name", s.name},
          {"triangles", s.object.mesh.triangles.size()},
          {"vertices", s.object.mesh.vertices.size()},
          {"nodes", s.object.mesh.nodes.size()},
          {"bytes_per_triangle", s.bytes_per_triangle},
          {"box_lower_m", to_json(s.lower())},
          {"box_upper_m", to_json(s.upper())},
          {"sides", s.sides()},
          {"contact", s.contact()},
          {"stiffness_N_per_m", material.stiffness_N_per_m},
          {"damping_Ns_per_m", material.damping_Ns_per_m},
          {"friction", to_json(material.friction)},
          {"grain", material.grain.differs() ? to_json(material.grain) : nlohmann::ordered_json()},
          {"shaded", !s.object.detail.corner_normals.empty()},
          {"textures", s.object.detail.layers.size()},
          {"texture_bytes", s.object.detail.texels.size()},
          {"moves", s.object.moves},
          {"dropped_triangles", s.counters.degenerate_triangles},
          {"welded_vertices", s.counters.welded_vertices},
          {"open_edges", s.counters.open_edges},
          {"non_manifold_edges", s.counters.non_manifold_edges},
          {"inconsistent_edges", s.counters.inconsistent_edges},
          {"holes", to_json(s.holes)},
          {"body_parts", json_of_parts(s.parts)},
          {"volume_m3", s.volume ? nlohmann::ordered_json(s.volume->volume_m3) : nullptr},
          {"parts_inside_out", s.volume ? nlohmann::ordered_json(s.volume->inside_out) : nullptr}};
}

void print_json(const InspectOptions& options, const MappedScene& scene) {
  nlohmann::ordered_json json{
      {"image", options.image},
      {"version", scene.image().version()},
      {"checksum", fmt::format("{:016x}", scene.image().checksum())},
      {"bytes", scene.bytes().size()},
      {"tool_radius_m", scene.image().tool_radius_m()},
      {"tool_count", scene.image().tool_count()},
      {"effects", scene.image().effects().size()},
      {"profiles", json_of_profiles(rendering::scene_counts(scene.image()), rendering::kProfiles)},
      {"objects", nlohmann::ordered_json::array()}};
  for (std::size_t i = 0; i < scene.image().objects().size(); ++i) {
    json["objects"].push_back(to_json(summarise(scene.image(), i)));
  }
  fmt::print("{}\n", json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

void print_friction(const rendering::Material& material) {
  std::string text = fmt::format("  friction   {}", model_of(material.friction.kind).name);
  for (const FrictionParameterName& name : surface_parameters(material.friction.kind)) {
    text += fmt::format(", {} {}", name.surface_key, material.friction.*name.member);
  }
  fmt::print("{}\n", text);
  const rendering::MaterialGrain& grain = material.grain;
  if (grain.differs()) {
    fmt::print("  grain      direction ({:.6g}, {:.6g}, {:.6g}), along {}, across {}\n",
               grain.direction_O.x, grain.direction_O.y, grain.direction_O.z, grain.along,
               grain.across);
  }
}

// Prints the volume of a mesh, and the remedy if it is inside out.
void print_volume(const ObjectSummary& s) {
  if (s.object.surface != rendering::SurfaceKind::mesh) {
    return;
  }
  const std::optional<ClosedVolume>& volume = s.volume;
  if (!volume) {
    fmt::print("  volume     none: the mesh is not closed\n");
    return;
  }
  fmt::print("  volume     {:.4g} m^3 in {} closed part{}\n", volume->volume_m3, volume->parts,
             volume->parts == 1 ? "" : "s");
  if (const auto warning = inside_out_warning(
          volume,
          "write flip = true at the object, or leave it out if it is there, and bake again")) {
    fmt::print("  advice     {}\n", *warning);
  }
}

// Prints the place and the size of each hole, the largest first.
void print_holes(const ObjectSummary& s) {
  constexpr std::size_t kMost = 20;
  for (const OpenLoop& hole : s.holes | std::views::take(kMost)) {
    fmt::print("  hole       {:.3g} mm at ({:.5g}, {:.5g}, {:.5g}) m, {} open edge{}{}\n",
               kMillimetresPerMetre * hole.size_m, hole.middle_W.x(), hole.middle_W.y(),
               hole.middle_W.z(), hole.corners.size(), hole.corners.size() == 1 ? "" : "s",
               hole.is_closed ? "" : ", no loop");
  }
  if (s.holes.size() > kMost) {
    fmt::print("  holes      {} in all; --json lists them\n", s.holes.size());
  }
  if (!s.holes.empty()) {
    fmt::print("  advice     cap_holes_mm = {:.3g} at the object closes {} when it is baked\n",
               cap_holes_mm_for(s.holes), s.holes.size() == 1 ? "it" : "all of them");
  }
}

void print_object(const ObjectSummary& s) {
  const rendering::Material& material = s.object.material;
  fmt::print("\n{}\n", s.name);
  fmt::print("  triangles  {}, vertices {}, hierarchy nodes {}, {:.1f} bytes a triangle\n",
             s.object.mesh.triangles.size(), s.object.mesh.vertices.size(),
             s.object.mesh.nodes.size(), s.bytes_per_triangle);
  fmt::print("  box        ({:.6g}, {:.6g}, {:.6g}) to ({:.6g}, {:.6g}, {:.6g}) m\n", s.lower().x,
             s.lower().y, s.lower().z, s.upper().x, s.upper().y, s.upper().z);
  fmt::print("  sides      {}, contact {}\n", s.sides(), s.contact());
  fmt::print("  stiffness  {} N/m, damping {} N s/m\n", material.stiffness_N_per_m,
             material.damping_Ns_per_m);
  print_friction(material);
  fmt::print("  detail     {}, {} texture{} of {} bytes{}\n",
             s.object.detail.corner_normals.empty() ? "flat" : "shaded",
             s.object.detail.layers.size(), s.object.detail.layers.size() == 1 ? "" : "s",
             s.object.detail.texels.size(), s.object.moves ? ", moves" : "");
  fmt::print("  edges      {} open, {} non-manifold, {} inconsistently wound\n",
             s.counters.open_edges, s.counters.non_manifold_edges, s.counters.inconsistent_edges);
  print_holes(s);
  print_volume(s);
  print_parts(s.parts);
  fmt::print("  baking     welded {} vertices, dropped {} triangles\n", s.counters.welded_vertices,
             s.counters.degenerate_triangles);
}

void print_text(const InspectOptions& options, const MappedScene& scene) {
  fmt::print("{}: format version {}, {} bytes, checksum {:016x} is right\n", options.image,
             scene.image().version(), scene.bytes().size(), scene.image().checksum());
  fmt::print("tool radius {} m, {} tool{}, {} object{}\n", scene.image().tool_radius_m(),
             scene.image().tool_count(), scene.image().tool_count() == 1 ? "" : "s",
             scene.image().objects().size(), scene.image().objects().size() == 1 ? "" : "s");
  if (!scene.image().effects().empty()) {
    fmt::print("effects {}\n", scene.image().effects().size());
  }
  for (std::size_t i = 0; i < scene.image().objects().size(); ++i) {
    print_object(summarise(scene.image(), i));
  }
  print_profiles(rendering::scene_counts(scene.image()), rendering::kProfiles);
}

void run(const InspectOptions& options) {
  if (options.graph.graph) {
    inspect_graph(options.graph, options.image, options.picture, options.json);
    return;
  }
  if (is_device_file(options.image)) {
    inspect_device({.device = options.image,
                    .scene = options.scene,
                    .picture = options.picture,
                    .json = options.json});
    return;
  }
  if (!options.scene.empty()) {
    throw InputError(fmt::format("--scene is for a device: tactus inspect arm.tactus --scene {}",
                                 options.scene));
  }
  const MappedScene scene(options.image);
  if (!options.picture.empty()) {
    keep_inputs_safe({options.picture}, {options.image});
    draw_holes(scene.image(), options.image, options.picture);
  }
  if (options.json) {
    print_json(options, scene);
  } else {
    print_text(options, scene);
  }
}

}  // namespace

void add_inspect_verb(CLI::App& app) {
  CLI::App* verb = app.add_subcommand(
      "inspect", "Check the image of a scene or a device and show what is in it");
  const auto options = std::make_shared<InspectOptions>();
  verb->add_option(
          "image", options->image,
          "Image (.tactus) of a scene or a device, a device.toml, or with --graph a mesh file")
      ->required();
  verb->add_option(
          "--picture,--figure", options->picture,
          "Draw the scene with the holes of its meshes, --graph, or the reach of a device, into "
          "this .png, .svg or .pdf file")
      ->check(picture_complaint);
  verb->add_option("--scene", options->scene,
                   "Of a device: say whether it reaches the objects of this scene image");
  verb->add_flag("--json", options->json, "Print one JSON object");
  add_graph_options(*verb, options->graph);
  verb->footer(kInspectExamples);
  verb->callback([options] { run(*options); });
}

}  // namespace tactus::host
