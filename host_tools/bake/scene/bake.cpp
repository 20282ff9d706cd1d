#include "host_tools/bake/scene/bake.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <iterator>
#include <utility>

#include "hal/angle.h"
#include "host_tools/bake/scene/corner_normals.h"
#include "host_tools/bake/scene/friction_check.h"
#include "host_tools/bake/scene/object_mesh.h"
#include "host_tools/bake/scene/part_bake.h"
#include "host_tools/bake/scene/progress.h"
#include "host_tools/bake/scene/size_check.h"
#include "host_tools/bake/scene/texture_bake.h"
#include "host_tools/files/atomic_file.h"
#include "host_tools/files/output_place.h"
#include "host_tools/input_error.h"
#include "rendering/objects/scene_objects.h"

namespace tactus::host {
namespace {

// Measures the time since it was made.
class Stopwatch {
 public:
  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// Throws InputError if the mesh file is missing. The scene names it, so the error points to the
// scene's line and not to the mesh.
void require_mesh_file(const ObjectDescription& object, const std::string& scene) {
  std::error_code error;
  if (!std::filesystem::exists(object.mesh, error)) {
    throw InputError(
        fmt::format("{}:{}: there is no mesh file {}; correct the path, it starts from the scene "
                    "file's folder",
                    scene, object.line, object.mesh.string()));
  }
}

// Adds shading normals and textures. Texture coordinates that no texture uses are dropped, since
// they are a large part of the image.
void add_detail(const ObjectDescription& object, const std::string& scene, BakedObject& baked) {
  BakedMesh& mesh = baked.mesh;
  if (object.detail.angle_limit_deg) {
    mesh.corner_normals = corner_normals(mesh.vertices, mesh.triangles, mesh.neighbours,
                                         hal::radians_of(*object.detail.angle_limit_deg));
  }
  baked.textures = bake_textures(object.detail, !mesh.corner_places.empty(), scene);
  if (std::ranges::none_of(baked.textures.layers, [](const rendering::TextureLayer& layer) {
        return layer.projection == rendering::TextureProjection::uv;
      })) {
    mesh.corner_places.clear();
  }
}

// Bakes the mesh by which a primitive or a formula is shown. Adds what it does not show to the
// warnings.
BakedMesh bake_picture(const ObjectDescription& object, const std::string& scene,
                       std::vector<std::string>& warnings) {
  try {
    FormulaPicture picture = picture_of(object.shape, object.placement, object.sides);
    for (const std::string& note : picture.notes) {
      warnings.push_back(fmt::format("{}: {}", object.name, note));
    }
    return bake_mesh(std::move(picture.mesh));
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}:{}: {}", scene, object.line, error.what()));
  }
}

// Bakes an object that is a primitive or a formula. Its report counts the triangles of its picture.
BakedObject bake_shape(const ObjectDescription& object, const std::string& scene,
                       ObjectReport& report, const Progress& progress) {
  const Stopwatch stopwatch;
  tell(progress, fmt::format("{}: drawing the shape", object.name));
  std::vector<std::string> warnings = check_formula(object, scene);
  BakedObject baked{.name = object.name,
                    .sides = object.sides,
                    .material = object.material,
                    .mesh = bake_picture(object, scene, warnings),
                    .shape = object.shape,
                    .placement = object.placement,
                    .contact = object.contact,
                    .push_out_m = object.push_out_m,
                    .textures = {},
                    .motion = object.motion};
  add_detail(object, scene, baked);
  report = {.name = object.name,
            .mesh = "",
            .triangles = baked.mesh.triangles.size(),
            .vertices = baked.mesh.vertices.size(),
            .lines_and_points = 0,
            .counters = baked.mesh.counters,
            .bytes = image_bytes(baked.mesh) + baked.textures.texels.size(),
            .seconds = stopwatch.seconds(),
            .warnings = std::move(warnings)};
  std::ranges::move(size_warnings(object, baked.mesh), std::back_inserter(report.warnings));
  return baked;
}

// Bakes an object that is a mesh.
BakedObject bake_object(const ObjectDescription& object, const std::string& scene,
                        ObjectReport& report, const Progress& progress) {
  const Stopwatch stopwatch;
  const ImportedMesh imported = mesh_of(object, scene, progress);
  tell(progress, fmt::format("{}: baking {} triangles", object.name, imported.triangles.size()));
  BakedObject baked{.name = object.name,
                    .sides = object.sides,
                    .material = object.material,
                    .mesh = bake_mesh_of(object, imported),
                    .shape = {},
                    .placement = {},
                    .contact = object.contact,
                    .push_out_m = object.push_out_m,
                    .textures = {},
                    .motion = object.motion};
  add_detail(object, scene, baked);
  report = {.name = object.name,
            .mesh = object.mesh.string(),
            .triangles = baked.mesh.triangles.size(),
            .vertices = baked.mesh.vertices.size(),
            .lines_and_points = imported.lines_and_points,
            .counters = baked.mesh.counters,
            .bytes = image_bytes(baked.mesh) + baked.textures.texels.size(),
            .seconds = stopwatch.seconds(),
            .warnings = mesh_warnings(object, imported, baked.mesh)};
  return baked;
}

// Bakes the body of an object that is one.
void add_body(const ObjectDescription& object, const std::string& scene, BakedObject& baked,
              ObjectReport& report) {
  if (!object.body) {
    return;
  }
  std::vector<std::string> notes;
  try {
    baked.body = bake_body(*object.body, baked.shape, object.placement, baked.mesh, notes);
  } catch (const InputError& error) {
    throw InputError(
        fmt::format("{}:{}: {}: {}", scene, object.body->line, object.name, error.what()));
  }
  baked.body->parts = bake_parts(object.body->parts, object.name, scene, notes);
  for (const std::string& note : notes) {
    report.warnings.push_back(fmt::format("{}: {}", object.name, note));
  }
}

// Tells that bodies go through the object, if they do.
void warn_of_passage(const BakedObject& object, bool is_with_bodies, ObjectReport& report) {
  if (is_with_bodies && object.motion.deforms) {
    report.warnings.push_back(fmt::format(
        "{}: bodies go through it: a mesh that deforms does not stop them", object.name));
  }
}

// Returns true if the scene has bodies. Throws InputError for more than the controller has room
// for.
bool has_bodies(const SceneDescription& description) {
  const auto bodies = std::ranges::count_if(
      description.objects, [](const ObjectDescription& object) { return object.body.has_value(); });
  if (bodies > static_cast<std::ptrdiff_t>(rendering::kMaxBodies)) {
    throw InputError(fmt::format("{}: {} bodies, where {} fit; leave some out", description.file,
                                 bodies, rendering::kMaxBodies));
  }
  const auto obstacles = std::ranges::count_if(
      description.objects,
      [](const ObjectDescription& object) { return !object.body && !object.motion.deforms; });
  if (bodies > 0 && obstacles > static_cast<std::ptrdiff_t>(rendering::kMaxObstacles)) {
    throw InputError(
        fmt::format("{}: {} objects without a body beside bodies, which can meet {} of them; leave "
                    "some out, or join their meshes",
                    description.file, obstacles, rendering::kMaxObstacles));
  }
  return bodies > 0;
}

// Returns an object with just what the controller's capacity depends on.
rendering::Object counted(rendering::ContactMethod method, const MotionDescription& motion,
                          const rendering::MeshView& mesh) {
  rendering::Object object;
  object.method = method;
  object.mesh = mesh;
  object.moves = motion.moves;
  object.deforms = motion.deforms;
  return object;
}

// Throws InputError if the objects exceed a capacity of the controller.
void require_room(const rendering::ObjectNeeds& needs, const std::string& file) {
  if (const auto exceeded = rendering::first_exceeded(needs.counts(), rendering::kProfile)) {
    std::array<char, 256> room{};
    throw InputError(fmt::format("{}: {}", file, rendering::exceeded_words(*exceeded, room)));
  }
}

// Returns the files that baking reads: the image must not replace one of them.
std::vector<std::filesystem::path> files_of(const std::filesystem::path& scene,
                                            const SceneDescription& description) {
  std::vector<std::filesystem::path> files = {scene};
  for (const ObjectDescription& object : description.objects) {
    files.push_back(object.mesh);
    if (object.body) {
      std::ranges::transform(object.body->parts, std::back_inserter(files), &PartDescription::mesh);
    }
    for (const TextureDescription& texture : object.detail.textures) {
      files.push_back(texture.image);
    }
  }
  return files;
}

}  // namespace

BakedImage bake_scene(const SceneDescription& description, const Progress& progress) {
  BakeReport report{.image = {},
                    .tool_radius_m = description.tool_radius_m,
                    .bytes = 0,
                    .seconds = 0.0,
                    .objects = {}};
  BakedScene baked{.tool_radius_m = description.tool_radius_m,
                   .tool_count = description.tool_count,
                   .objects = {},
                   .effects = description.effects,
                   .gravity_W = description.gravity_W,
                   .soft_finger_modulus_Pa = description.soft_finger_modulus_Pa,
                   .sleep_after_s = description.sleep_after_s,
                   .needle = description.needle};
  // Counted twice: first without the sizes of meshes, so that a scene with too many objects is
  // refused before minutes of baking, then with them.
  rendering::ObjectNeeds needs;
  for (const ObjectDescription& object : description.objects) {
    if (!object.mesh.empty()) {
      require_mesh_file(object, description.file);
    }
    require_stable_friction(object, description);
    needs.add(counted(object.contact, object.motion, {}));
  }
  require_room(needs, description.file);
  const bool is_with_bodies = has_bodies(description);
  check_parts(description);
  for (const ObjectDescription& object : description.objects) {
    ObjectReport& own = report.objects.emplace_back();
    baked.objects.push_back(is_touched_as_mesh(object)
                                ? bake_object(object, description.file, own, progress)
                                : bake_shape(object, description.file, own, progress));
    baked.objects.back().tissue = object.tissue;
    add_body(object, description.file, baked.objects.back(), own);
    warn_of_passage(baked.objects.back(), is_with_bodies, own);
    std::ranges::move(friction_warnings(object, description), std::back_inserter(own.warnings));
  }
  needs = {};
  for (const BakedObject& object : baked.objects) {
    needs.add(counted(object.contact, object.motion, object.mesh.view()));
  }
  require_room(needs, description.file);
  std::vector<std::byte> bytes = write_image(baked);
  report.bytes = bytes.size();
  return {.bytes = std::move(bytes), .report = std::move(report)};
}

BakeReport bake_file(const std::filesystem::path& scene, const std::filesystem::path& image,
                     const Progress& progress) {
  const Stopwatch stopwatch;
  const SceneDescription description = read_scene_description(scene);
  keep_inputs_safe(std::array{image}, files_of(scene, description));
  BakedImage baked = bake_scene(description, progress);
  tell(progress, fmt::format("writing {}", image.string()));
  write_file_atomically(image, baked.bytes);
  baked.report.image = image.string();
  baked.report.seconds = stopwatch.seconds();
  return baked.report;
}

}  // namespace tactus::host
