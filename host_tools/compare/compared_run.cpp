#include "host_tools/compare/compared_run.h"

#include <fmt/format.h>

#include <memory>

#include "host_tools/bake/scene/bake.h"
#include "host_tools/bake/scene/mapped_scene.h"
#include "host_tools/input_error.h"
#include "rendering/scene/scene_world.h"
#include "rendering/surface/connected_mesh.h"
#include "rendering/surface/primitive.h"
#include "rendering/world/world.h"

namespace tactus::host {
namespace {

// Returns the signed distance of the proxy from the surface that it touches, m.
double height_of(const rendering::Touch& touch, const rendering::Object& object,
                 double tool_radius_m) {
  if (touch.contact == rendering::ContactKind::none || rendering::is_mover(object)) {
    return 0.0;
  }
  const double radius_m =
      object.method == rendering::ContactMethod::sphere_proxy ? tool_radius_m : 0.0;
  switch (object.surface) {
    case rendering::SurfaceKind::primitive:
      return sample(object.primitive, touch.proxy_W).distance_m - radius_m;
    case rendering::SurfaceKind::implicit: {
      const rendering::ImplicitSurface& surface = object.implicit;
      const rendering::ValueAndGradient f =
          evaluate_gradient(surface.formula, surface.to_object(touch.proxy_W));
      return surface.scale_m * f.value / f.gradient.norm();
    }
    default:
      return sample(rendering::ConnectedMesh{object.mesh, object.neighbours, object.vertex_normals},
                    touch.proxy_W)
                 .distance_m -
             radius_m;
  }
}

}  // namespace

ComparedRun follow(const std::string& name, const SceneDescription& scene, const ToolPath& path,
                   const Progress& progress) {
  const BakedImage baked = bake_scene(scene, progress);
  const auto image = rendering::SceneImage::open(baked.bytes);
  if (!image) {
    throw InputError(fmt::format("{}: {}: {}", scene.file, name, explain(image.error())));
  }
  const auto world = std::make_unique<rendering::World>();
  if (!world->set_scene(image->objects(), rendering::world_of(*image))) {
    throw InputError(fmt::format("{}: {}: the world refuses the scene", scene.file, name));
  }
  ComparedRun run{.name = name, .ticks = {}};
  run.ticks.reserve(path.size());
  constexpr std::size_t kTicksBetweenSteps = 4096;
  for (std::size_t k = 0; k < path.size(); ++k) {
    const rendering::ToolState tool = path.tool(k);
    world->set_tick(path.step_s(k));
    const rendering::Touch touch = world->touch(tool, nullptr);
    const double height_m =
        image->objects().empty()
            ? 0.0
            : height_of(touch, image->objects()[touch.object], image->tool_radius_m());
    run.ticks.push_back(
        {.t_s = path.time_s(k), .tool_W = tool.p_W, .touch = touch, .height_m = height_m});
    if (progress && k % kTicksBetweenSteps == 0) {
      progress(fmt::format("{}: {} of {} ticks", name, k, path.size()));
    }
  }
  return run;
}

}  // namespace tactus::host
