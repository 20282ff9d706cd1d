#include "rendering/objects/movers.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "rendering/tick_budget.h"

namespace tactus::rendering {
namespace {

// The bounds of a plane that moves. The box of a plane at rest is the world's, and would move
// along.
const Bounds kEverywhere{.lower_W = Vec3::Constant(-1e6), .upper_W = Vec3::Constant(1e6)};

// Returns the distance from the middle of the box to the farthest vertex of a rigid mesh, m;
// infinity for another object.
double farthest_vertex_m(const Object& object, const Bounds& box_O) {
  if (object.surface != SurfaceKind::mesh || object.deforms) {
    return std::numeric_limits<double>::infinity();
  }
  const Vec3 middle_O = 0.5 * (box_O.lower_W + box_O.upper_W);
  double squared = 0.0;
  for (const Float3& vertex : object.mesh.vertices) {
    squared = std::max(squared, (to_vec3(vertex) - middle_O).squaredNorm());
  }
  return std::sqrt(squared);
}

// Returns true if the pose is a rotation to 1e-9 and within the world. A component that is not a
// number fails, because it propagates to the maximum.
bool sound(const RigidPose& pose) {
  constexpr double kOrthonormal = 1e-9;
  return (pose.rotation.transpose() * pose.rotation - Mat3::Identity())
                 .cwiseAbs()
                 .maxCoeff<Eigen::PropagateNaN>() <= kOrthonormal &&
         pose.rotation.determinant() > 0.0 &&
         pose.translation.cwiseAbs().maxCoeff<Eigen::PropagateNaN>() <= kWorldBound_m;
}

}  // namespace

bool Mover::is_near(const Vec3& p_W, double reach_m) const {
  const double most = radius_m + reach_m;
  return (p_W - middle_W).squaredNorm() <= most * most &&
         bounds_O.distance(X_WO.point_in(p_W)) <= reach_m;
}

bool Mover::was_near(const Vec3& p_W, double reach_m) const {
  const double most = radius_m + reach_m;
  return (p_W - middle_before_W).squaredNorm() <= most * most &&
         bounds_O.distance(X_WO_before.point_in(p_W)) <= reach_m;
}

// With m the middle, u = X_before^-1 from - m and R the rotations, the point goes in the frame O by
//
//   |X_now^-1 to - X_before^-1 from| = |(to - from) + (m_before - m_now) + (R_before - R_now) u|.
bool Mover::is_passed_by(const Vec3& from_W, double distance_m, double reach_m) const {
  const double from_middle_m = (from_W - middle_before_W).norm();
  const double motion_m = distance_m + shift_m + turn * from_middle_m;
  return from_middle_m - radius_m > motion_m + reach_m;
}

// The radius has room for the roundings of places in the world.
void Mover::set_bounds(const Bounds& box_O, double reaches_m) {
  constexpr double kRounding_m = 1e-9;
  bounds_O = box_O;
  const double corner_m = 0.5 * (box_O.upper_W - box_O.lower_W).norm();
  radius_m = std::min(corner_m, reaches_m) * (1.0 + kRounding_m) + kRounding_m;
}

void Mover::place_ball() {
  const Vec3 middle_O = 0.5 * (bounds_O.lower_W + bounds_O.upper_W);
  middle_W = X_WO.point(middle_O);
  middle_before_W = X_WO_before.point(middle_O);
  shift_m = (middle_W - middle_before_W).norm();
  turn = (X_WO.rotation - X_WO_before.rotation).norm();
}

// All objects are visited even after a failure: every entry of mover_of_ must be set.
bool Movers::start(std::span<const Object> objects) {
  objects_ = objects;
  count_ = deformable_count_ = 0;
  pool_.vertices_used = pool_.nodes_used = 0;
  anything_moved_ = false;
  bool good = true;
  for (std::uint32_t i = 0; i < objects_.size(); ++i) {
    mover_of_[i] = kNoMover;
    good = good && (!is_mover(objects_[i]) || start_one(i));
  }
  return good;
}

bool Movers::start_one(std::uint32_t number) {
  const Object& object = objects_[number];
  mover_of_[number] = static_cast<std::uint8_t>(count_);
  orders_[count_] = {};
  Mover& mover = movers_[count_++];
  mover = {.object = number, .primitive_W = object.primitive, .motion = object.motion};
  const bool is_plane =
      object.surface == SurfaceKind::primitive && object.primitive.kind == PrimitiveKind::plane;
  const Bounds box_O = is_plane ? kEverywhere : bounds_of(object);
  mover.set_bounds(box_O, farthest_vertex_m(object, box_O));
  mover.place_ball();
  if (!object.deforms) {
    return true;
  }
  if (deformable_count_ == kMaxDeformables) {
    return false;
  }
  DeformableMesh& deformable = deformables_[deformable_count_++];
  mover.deformable = &deformable;
  if (!deformable.start(object.mesh, pool_)) {
    return false;
  }
  mover.wave = start_wave(object);
  return true;
}

// Called when the pool has the vertices of the object.
WaveVertices Movers::start_wave(const Object& object) {
  if (object.motion == nullptr || object.motion->wave_m == 0.0) {
    return {};
  }
  return wave_pool_.start(*object.motion, pool_.vertices_used - object.mesh.vertices.size(),
                          object.mesh.vertices, object.vertex_normals);
}

DeformableMesh& Movers::deformable_of(const Mover& mover) {
  return deformables_[static_cast<std::size_t>(mover.deformable - deformables_.data())];
}

bool Movers::move_vertex(std::uint32_t number, std::uint32_t vertex, const Vec3& p_O) {
  if (!objects_[number].deforms) {
    return false;
  }
  Mover& mover = movers_[mover_of_[number]];
  const bool good = deformable_of(mover).move_vertex(vertex, p_O);
  mover.motion = good ? nullptr : mover.motion;
  return good;
}

bool Movers::set_pose(std::uint32_t number, const RigidPose& X_WO, const Twist& twist) {
  if (mover_of_[number] == kNoMover || !sound(X_WO) || !twist.linear_W.allFinite() ||
      !twist.angular_W.allFinite()) {
    return false;
  }
  orders_[mover_of_[number]] = {.X_WO = X_WO, .twist = twist};
  movers_[mover_of_[number]].motion = nullptr;
  return true;
}

std::size_t Movers::begin_tick(double time_s) {
  anything_moved_ = false;
  std::size_t cost = 0;
  for (std::size_t k = 0; k < count_; ++k) {
    cost += begin_tick_of(k, time_s);
    anything_moved_ = anything_moved_ || movers_[k].moved;
  }
  return cost;
}

// Moves some vertices per tick, in turns, from next_vertex on and then from the first one. The
// target of each is its place at rest, moved along the normal at rest, so that nothing drifts.
std::size_t Movers::wave(Mover& mover, double time_s) {
  const SineCosine of_time = wave_angle(*mover.motion, time_s);
  const std::size_t count = mover.wave.rest.size();
  const std::size_t turns = std::min(kWaveVertices, count);
  for (std::size_t left = turns; left > 0;) {
    const std::size_t part = std::min<std::size_t>(left, count - mover.next_vertex);
    rendering::wave(*mover.motion, of_time, mover.wave.part(mover.next_vertex, part),
                    deformable_of(mover).want(mover.next_vertex, part));
    mover.next_vertex = static_cast<std::uint32_t>((mover.next_vertex + part) % count);
    left -= part;
  }
  return turns / kVertexWavesPerUnit;
}

// The order matters: the deformable takes its step first, because the bounds and `moved` follow
// from it; the pose of the last tick is kept, because carrying sweeps between the two.
std::size_t Movers::begin_tick_of(std::size_t k, double time_s) {
  Mover& mover = movers_[k];
  std::size_t cost = kCostOfMover;
  if (mover.motion != nullptr) {
    const Placement at = place_at(*mover.motion, time_s);
    orders_[k] = {.X_WO = at.X_WO, .twist = at.twist};
    if (!mover.wave.rest.empty()) {
      cost += wave(mover, time_s);
    }
  }
  if (mover.deformable != nullptr) {
    cost += deformable_of(mover).begin_tick();
  }
  mover.X_WO_before = mover.X_WO;
  mover.X_WO = orders_[k].X_WO;
  mover.twist = orders_[k].twist;
  mover.moved = mover.X_WO.rotation != mover.X_WO_before.rotation ||
                mover.X_WO.translation != mover.X_WO_before.translation;
  if (mover.moved && objects_[mover.object].surface != SurfaceKind::mesh) {
    // A primitive has a pose of its own within O.
    const RigidPose& own = objects_[mover.object].primitive.X_WO;
    mover.primitive_W.X_WO = {.rotation = mover.X_WO.rotation * own.rotation,
                              .translation = mover.X_WO.point(own.translation)};
  }
  if (mover.deformable != nullptr && mover.deformable->slack_m() > 0.0) {
    // The box of a mesh that deforms changes, and its hierarchy lags the vertices by the slack.
    const BvhNode& root = mover.deformable->now().nodes[0];
    const Vec3 slack = Vec3::Constant(mover.deformable->slack_m());
    mover.set_bounds(
        {.lower_W = to_vec3(root.lower) - slack, .upper_W = to_vec3(root.upper) + slack});
    mover.moved = mover.moved || mover.deformable->step_m() > 0.0;
  }
  mover.place_ball();
  return cost;
}

}  // namespace tactus::rendering
