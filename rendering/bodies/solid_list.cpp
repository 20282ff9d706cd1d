#include "rendering/bodies/solid_list.h"

#include <algorithm>

namespace tactus::rendering {
namespace {

bool is_hull(const ConvexHull& hull) {
  return !hull.vertices_O.empty() && hull.vertices_O.size() <= kMaxHullVertices;
}

}  // namespace

void SolidList::clear() {
  body_count_ = 0;
  part_count_ = 0;
  obstacle_count_ = 0;
  obstacle_moves_.fill(false);
}

bool SolidList::add_body(const BodyStart& start) {
  const std::span<const ConvexHull> parts = start.parts;
  const bool has_room = body_count_ < kMaxBodies && parts.size() <= kMaxPartsOfBody &&
                        parts.size() <= kMaxBodyParts - part_count_;
  const bool has_shape =
      parts.empty() ? is_hull(start.body.hull) : std::ranges::all_of(parts, is_hull);
  if (!has_room || !has_shape || !valid(start.body.mass)) {
    return false;
  }
  first_part_[body_count_] = static_cast<std::uint16_t>(part_count_);
  part_count_ += parts.size();
  bodies_[body_count_] =
      RigidBody(start.body.mass, start.X_WO, start.body.velocity_W, start.body.angular_velocity_O);
  starts_[body_count_++] = start;
  return true;
}

bool SolidList::add_obstacle(const BodyObstacle& obstacle) {
  const bool is_good = !obstacle.has_hull() || is_hull(obstacle.hull);
  if (obstacle_count_ == kMaxObstacles || !is_good) {
    return false;
  }
  obstacles_[obstacle_count_++] = obstacle;
  return true;
}

void SolidList::set_obstacle(std::size_t obstacle, const RigidPose& X_WO, const Twist& twist,
                             bool moves) {
  obstacles_[obstacle].X_WO = X_WO;
  obstacles_[obstacle].twist = twist;
  obstacle_moves_[obstacle] = moves;
}

bool SolidList::any_obstacle_moves() const {
  return std::ranges::any_of(std::span(obstacle_moves_).first(obstacle_count_),
                             [](bool moves) { return moves; });
}

}  // namespace tactus::rendering
