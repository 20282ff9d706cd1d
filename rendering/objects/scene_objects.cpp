#include "rendering/objects/scene_objects.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "rendering/geometry/hierarchy_query.h"

namespace tactus::rendering {
namespace {

// The bounds of a plane that moves. The box of a plane at rest is the world's, and would move
// along.
const Bounds kEverywhere{.lower_W = Vec3::Constant(-1e6), .upper_W = Vec3::Constant(1e6)};

bool sound(const RigidPose& pose) {
  constexpr double kOrthonormal = 1e-9;
  return (pose.rotation.transpose() * pose.rotation - Mat3::Identity())
                 .cwiseAbs()
                 .maxCoeff<Eigen::PropagateNaN>() <= kOrthonormal &&
         pose.rotation.determinant() > 0.0 &&
         pose.translation.cwiseAbs().maxCoeff<Eigen::PropagateNaN>() <= kWorldBound_m;
}

Float3 rounded(const Vec3& p, float toward) {
  const auto away = [toward](double x) { return std::nextafter(static_cast<float>(x), toward); };
  return {away(p.x()), away(p.y()), away(p.z())};
}

void grow(BvhNode& box, const Bounds& by) {
  constexpr float kFar = std::numeric_limits<float>::infinity();
  const Float3 lower = rounded(by.lower_W, -kFar);
  const Float3 upper = rounded(by.upper_W, kFar);
  box.lower = {std::min(box.lower.x, lower.x), std::min(box.lower.y, lower.y),
               std::min(box.lower.z, lower.z)};
  box.upper = {std::max(box.upper.x, upper.x), std::max(box.upper.y, upper.y),
               std::max(box.upper.z, upper.z)};
}

}  // namespace

double Mover::distance(const Vec3& p_W) const {
  return bounds_O.distance(X_WO.point_in(p_W));
}

double Mover::distance_before(const Vec3& p_W) const {
  return bounds_O.distance(X_WO_before.point_in(p_W));
}

void SceneCapacityNeeds::add(const Object& object) {
  movers += is_mover(object) ? 1U : 0U;
  independent += meets_proxy(object) ? 0U : 1U;
  if (object.deforms) {
    ++deformables;
    deformable_vertices += object.mesh.vertices.size();
    deformable_nodes += object.mesh.nodes.size();
  }
}

bool SceneCapacityNeeds::fit() const {
  return movers <= kMaxMovers && independent <= kMaxIndependentObjects &&
         deformables <= kMaxDeformables && deformable_vertices <= kMaxDeformableVertices &&
         deformable_nodes <= kMaxDeformableNodes;
}

bool SceneObjects::set(std::span<const Object> objects) {
  SceneCapacityNeeds needs;
  std::ranges::for_each(objects, [&](const Object& object) { needs.add(object); });
  bool good = objects.size() <= kMaxObjects && needs.fit() && std::ranges::all_of(objects, usable);
  objects_ = good ? objects : std::span<const Object>{};
  mover_count_ = independent_count_ = deformable_count_ = 0;
  changed_of_.fill(kUnchanged);
  changed_count_ = 0;
  pool_.vertices_used = pool_.nodes_used = 0;
  anything_moved_ = false;
  for (std::uint32_t i = 0; i < objects_.size(); ++i) {
    mover_of_[i] = kNoMover;
    if (!meets_proxy(objects_[i])) {
      independent_[independent_count_++] = i;
    }
    good = good && (!is_mover(objects_[i]) || start_mover(i));
  }
  if (!good) {
    objects_ = {};
    mover_count_ = independent_count_ = 0;
  }
  build_hierarchy();
  return good;
}

bool SceneObjects::start_mover(std::uint32_t number) {
  const Object& object = objects_[number];
  mover_of_[number] = static_cast<std::uint8_t>(mover_count_);
  orders_[mover_count_] = {};
  Mover& mover = movers_[mover_count_++];
  mover = {.object = number,
           .primitive_W = object.primitive,
           .bounds_O = bounds_of(object),
           .motion = object.motion};
  if (object.surface == SurfaceKind::primitive && object.primitive.kind == PrimitiveKind::plane) {
    mover.bounds_O = kEverywhere;
  }
  if (!object.deforms) {
    return true;
  }
  if (deformable_count_ == kMaxDeformables) {
    return false;
  }
  DeformableMesh& deformable = deformables_[deformable_count_++];
  mover.deformable = &deformable;
  return deformable.start(object.mesh, pool_);
}

DeformableMesh& SceneObjects::deformable_of(const Mover& mover) {
  return deformables_[static_cast<std::size_t>(mover.deformable - deformables_.data())];
}

bool SceneObjects::move_vertex(std::uint32_t number, std::uint32_t vertex, const Vec3& p_O) {
  if (number >= objects_.size() || !objects_[number].deforms) {
    return false;
  }
  Mover& mover = movers_[mover_of_[number]];
  const bool good = deformable_of(mover).move_vertex(vertex, p_O);
  mover.motion = good ? nullptr : mover.motion;
  return good;
}

bool SceneObjects::set_pose(std::uint32_t number, const RigidPose& X_WO, const Twist& twist) {
  if (number >= objects_.size() || mover_of_[number] == kNoMover || !sound(X_WO) ||
      !twist.linear_W.allFinite() || !twist.angular_W.allFinite()) {
    return false;
  }
  orders_[mover_of_[number]] = {.X_WO = X_WO, .twist = twist};
  movers_[mover_of_[number]].motion = nullptr;
  return true;
}

bool SceneObjects::set_material(std::uint32_t number, const Material& material) {
  if (number >= objects_.size() || !sound(material)) {
    return false;
  }
  if (changed_of_[number] == kUnchanged) {
    if (changed_count_ == kMaxChangedMaterials) {
      return false;
    }
    changed_of_[number] = static_cast<std::uint8_t>(changed_count_++);
  }
  changed_materials_[changed_of_[number]] = material;
  return true;
}

void SceneObjects::begin_tick(double time_s, double tick_s) {
  tick_s_ = tick_s;
  anything_moved_ = false;
  for (std::size_t k = 0; k < mover_count_; ++k) {
    begin_tick_of(k, time_s);
    anything_moved_ = anything_moved_ || movers_[k].moved;
  }
}

// Moves some vertices per tick, in turns.
void SceneObjects::wave(Mover& mover, double time_s) {
  const Object& object = objects_[mover.object];
  const auto count = static_cast<std::uint32_t>(object.mesh.vertices.size());
  DeformableMesh& mesh = deformable_of(mover);
  for (std::size_t k = 0; k < std::min<std::size_t>(kWaveVertices, count); ++k) {
    const std::uint32_t i = mover.next_vertex;
    mover.next_vertex = i + 1 == count ? 0 : i + 1;
    const Vec3 rest_O = to_vec3(object.mesh.vertices[i]);
    mesh.move_vertex(
        i, rest_O + wave_at(*mover.motion, rest_O, time_s) * to_vec3(object.vertex_normals[i]));
  }
}

void SceneObjects::begin_tick_of(std::size_t k, double time_s) {
  Mover& mover = movers_[k];
  if (mover.motion != nullptr) {
    const Placement at = place_at(*mover.motion, time_s);
    orders_[k] = {.X_WO = at.X_WO, .twist = at.twist};
    if (mover.deformable != nullptr && mover.motion->wave_m != 0.0) {
      wave(mover, time_s);
    }
  }
  if (mover.deformable != nullptr) {
    deformable_of(mover).begin_tick();
  }
  mover.X_WO_before = mover.X_WO;
  mover.X_WO = orders_[k].X_WO;
  mover.twist = orders_[k].twist;
  mover.moved = mover.X_WO.rotation != mover.X_WO_before.rotation ||
                mover.X_WO.translation != mover.X_WO_before.translation;
  if (mover.moved) {
    const RigidPose& own = objects_[mover.object].primitive.X_WO;
    mover.primitive_W.X_WO = {.rotation = mover.X_WO.rotation * own.rotation,
                              .translation = mover.X_WO.point(own.translation)};
  }
  if (mover.deformable != nullptr && mover.deformable->slack_m() > 0.0) {
    const BvhNode& root = mover.deformable->now().nodes[0];
    const Vec3 slack = Vec3::Constant(mover.deformable->slack_m());
    mover.bounds_O = {.lower_W = to_vec3(root.lower) - slack,
                      .upper_W = to_vec3(root.upper) + slack};
    mover.moved = mover.moved || mover.deformable->step_m() > 0.0;
  }
}

// Splits in halves along the longest side of the centres' box, so the depth is the logarithm of the
// count.
void SceneObjects::build_hierarchy() {
  std::uint32_t count = 0;
  for (std::uint32_t i = 0; i < objects_.size(); ++i) {
    if (meets_proxy(objects_[i]) && !is_mover(objects_[i])) {
      order_[count++] = i;
    }
  }
  node_count_ = 0;
  if (count == 0) {
    return;
  }
  constexpr std::uint32_t kLeaf = 2;
  std::array<Part, kMaxHierarchyDepth> parts;
  std::size_t waiting = 0;
  parts[waiting++] = {.node = 0, .first = 0, .count = count};
  node_count_ = 1;
  while (waiting > 0) {
    const Part part = parts[--waiting];
    const Eigen::Index axis = enclose(part);
    BvhNode& box = nodes_[part.node];
    if (part.count <= kLeaf) {
      box.first = part.first;
      box.triangle_count = part.count;
      continue;
    }
    const std::uint32_t half = part.count / 2;
    halve(part, axis);
    box.first = static_cast<std::uint32_t>(node_count_);
    node_count_ += 2;
    parts[waiting++] = {.node = box.first, .first = part.first, .count = half};
    parts[waiting++] = {
        .node = box.first + 1, .first = part.first + half, .count = part.count - half};
  }
}

Vec3 SceneObjects::centre(std::uint32_t number) const {
  const Bounds box = bounds_of(objects_[number]);
  return 0.5 * (box.lower_W + box.upper_W);
}

// Sets the box of the part's node, and returns the axis along which its objects are spread most.
Eigen::Index SceneObjects::enclose(const Part& part) {
  constexpr float kFar = std::numeric_limits<float>::infinity();
  BvhNode& box = nodes_[part.node];
  box = {.lower = {kFar, kFar, kFar}, .upper = {-kFar, -kFar, -kFar}};
  Eigen::AlignedBox3d centres;
  for (const std::uint32_t number : std::span(order_).subspan(part.first, part.count)) {
    grow(box, bounds_of(objects_[number]));
    centres.extend(centre(number));
  }
  Eigen::Index widest = 0;
  centres.sizes().maxCoeff(&widest);
  return widest;
}

void SceneObjects::halve(const Part& part, Eigen::Index axis) {
  const auto range = std::span(order_).subspan(part.first, part.count);
  std::ranges::nth_element(range, range.begin() + static_cast<std::ptrdiff_t>(part.count / 2),
                           [&](std::uint32_t a, std::uint32_t b) {
                             const double of_a = centre(a)[axis];
                             const double of_b = centre(b)[axis];
                             return of_a < of_b || (of_a == of_b && a < b);
                           });
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
