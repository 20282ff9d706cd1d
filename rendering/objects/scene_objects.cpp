#include "rendering/objects/scene_objects.h"

#include <algorithm>
#include <cstddef>

#include "rendering/tick_budget.h"

namespace tactus::rendering {

void ObjectNeeds::add(const Object& object) {
  ++counts_.objects;
  counts_.movers += is_mover(object) ? 1U : 0U;
  counts_.independent_objects += is_independent(object) ? 1U : 0U;
  counts_.bodies += is_body(object) ? 1U : 0U;
  solids_ += !is_body(object) && !object.deforms ? 1U : 0U;
  motion_units_ += is_mover(object) ? kCostOfMover : 0U;
  if (object.deforms) {
    motion_units_ += std::min(kWaveVertices, object.mesh.vertices.size()) / kVertexWavesPerUnit +
                     object.mesh.vertices.size() / kVertexStepsPerUnit +
                     object.mesh.vertices.size() / kVertexLongStepsPerUnit +
                     std::min(kRefitNodes, object.mesh.nodes.size()) / kRefitsPerUnit;
    ++counts_.deformables;
    counts_.deformable_vertices += object.mesh.vertices.size();
    counts_.deformable_nodes += object.mesh.nodes.size();
  }
}

SceneCounts ObjectNeeds::counts() const {
  SceneCounts counts = counts_;
  counts.obstacles = counts_.bodies > 0 ? solids_ : 0;
  return counts;
}

ObjectNeeds needs_of(std::span<const Object> objects) {
  ObjectNeeds needs;
  std::ranges::for_each(objects, [&](const Object& object) { needs.add(object); });
  return needs;
}

// A scene that is refused leaves the same state as an empty one.
bool SceneObjects::set(std::span<const Object> objects) {
  const bool fit =
      !first_exceeded(needs_of(objects).counts(), kProfile) && std::ranges::all_of(objects, usable);
  objects_ = fit ? objects : std::span<const Object>{};
  const bool good = movers_.start(objects_) && fit;
  if (!good) {
    objects_ = {};
    movers_.start({});
  }
  changed_.clear();
  group();
  return good;
}

std::size_t SceneObjects::count_independent() const {
  std::size_t count = 0;
  for (std::uint32_t i = 0; i < objects_.size(); ++i) {
    count += is_independent((*this)[i]) ? 1U : 0U;
  }
  return count;
}

void SceneObjects::group() {
  independent_count_ = 0;
  for (std::uint32_t i = 0; i < objects_.size(); ++i) {
    if (is_independent((*this)[i])) {
      independent_[independent_count_++] = i;
    }
  }
  still_.build(objects_, changed_);
}

bool SceneObjects::set_pose(std::uint32_t number, const RigidPose& X_WO, const Twist& twist) {
  return number < objects_.size() && movers_.set_pose(number, X_WO, twist);
}

bool SceneObjects::move_vertex(std::uint32_t number, std::uint32_t vertex, const Vec3& p_O) {
  return number < objects_.size() && movers_.move_vertex(number, vertex, p_O);
}

bool SceneObjects::set_material(std::uint32_t number, const Material& material) {
  if (number >= objects_.size() || !sound(material)) {
    return false;
  }
  Object* const changed = changed_.change(number, objects_[number]);
  if (changed != nullptr) {
    changed->material = material;
  }
  return changed != nullptr;
}

bool SceneObjects::set_method(std::uint32_t number, ContactMethod method) {
  if (number >= objects_.size() || !can_render(method, (*this)[number], material(number)) ||
      !has_room_for(number, method)) {
    return false;
  }
  Object* const changed = changed_.change(number, objects_[number]);
  if (changed == nullptr) {
    return false;
  }
  const bool regroups = meets_proxy(*changed) != meets_proxy(method);
  changed->method = method;
  if (regroups) {
    group();
  }
  return true;
}

std::size_t SceneObjects::begin_tick(double time_s, double tick_s) {
  tick_s_ = tick_s;
  return movers_.begin_tick(time_s);
}

Triangle triangle_W(const SceneObjects& scene, std::uint32_t number, std::uint32_t triangle) {
  const MeshView mesh = scene.mesh_O(number).mesh;
  const Mover* const mover = scene.mover_of(number);
  const TriangleIndices& corners = mesh.triangles[triangle];
  return {point_from(mover, to_vec3(mesh.vertices[corners[0]])),
          point_from(mover, to_vec3(mesh.vertices[corners[1]])),
          point_from(mover, to_vec3(mesh.vertices[corners[2]]))};
}

}  // namespace tactus::rendering
