#include "rendering/world/world_bodies.h"

#include <algorithm>
#include <ranges>

#include "rendering/bodies/body_energy.h"

namespace tactus::rendering {
namespace {

// Returns the surface of an object against other objects; `body` may be nullptr.
ContactSurface surface_of(const SceneObjects& scene, std::uint32_t number, const ObjectBody* body) {
  ContactSurface surface{.friction = scene.material(number).friction.coulomb};
  if (body != nullptr) {
    surface.restitution = body->restitution;
    surface.rolling_m = body->rolling_friction_m;
    surface.spinning_m = body->spinning_friction_m;
  }
  return surface;
}

}  // namespace

bool WorldBodies::set(const SceneObjects& scene, std::span<const ObjectBody> bodies,
                      std::span<const BodyPart> parts, const BodyLaws& laws) {
  bodies_.clear();
  obstacle_count_ = 0;
  work_by_hands_J_.fill(0.0);
  bodies_.set_gravity(laws.gravity_W);
  bodies_.set_soft_fingers(laws.finger_yield_m3_per_N);
  bodies_.set_sleep(laws.sleep_after_s);
  if (!make_parts(parts)) {
    return false;
  }
  const auto numbers = std::views::iota(0U, static_cast<std::uint32_t>(scene.size()));
  const bool any_body =
      std::ranges::any_of(numbers, [&](std::uint32_t number) { return is_body(scene[number]); });
  if (!any_body) {
    return true;
  }
  const bool all_added = std::ranges::all_of(numbers, [&](std::uint32_t number) {
    const std::uint8_t body = scene[number].body;
    const bool is_there = body == kNoBody || body < bodies.size();
    return is_there && add(scene, number, body == kNoBody ? nullptr : &bodies[body]);
  });
  if (!all_added) {
    bodies_.clear();
    obstacle_count_ = 0;
  }
  return all_added;
}

bool WorldBodies::add(const SceneObjects& scene, std::uint32_t number, const ObjectBody* body) {
  const Object& object = scene[number];
  if (body == nullptr && object.deforms) {
    return true;  // bodies go through it
  }
  const bool is_primitive = object.surface == SurfaceKind::primitive;
  const std::size_t count = body != nullptr ? bodies_.bodies().size() : obstacle_count_;
  if (count == (body != nullptr ? kMaxBodies : kMaxObstacles)) {
    return false;
  }
  ConvexHull hull = body != nullptr ? body->hull : ConvexHull{};
  if (is_primitive && has_hull(object.primitive.kind)) {
    PrimitiveHull& own = hulls_[body != nullptr ? count : kMaxBodies + count];
    own.make(object.primitive);
    hull = own.hull();
  }
  const ContactSurface surface = surface_of(scene, number, body);
  if (body != nullptr) {
    body_objects_[count] = number;
    return add_body(*body, hull, surface);
  }
  obstacle_objects_[count] = number;
  ++obstacle_count_;
  const bool is_field = is_primitive && object.primitive.kind == PrimitiveKind::torus;
  const bool is_formula = object.surface == SurfaceKind::implicit;
  return bodies_.add_obstacle(
      {.mesh = is_primitive || is_formula ? MeshView{} : object.mesh,
       .sides = object.sides,
       .field = {.primitive = is_field ? &scene.unchanged(number).primitive : nullptr,
                 .implicit = is_formula ? &scene.unchanged(number).implicit : nullptr},
       .hull = hull,
       .plane_O = object.primitive.X_WO,
       .surface = surface,
       .X_WO = {},
       .twist = {}});
}

bool WorldBodies::make_parts(std::span<const BodyPart> parts) {
  part_count_ = 0;
  const bool are_good = std::ranges::all_of(parts, [](const BodyPart& part) {
    return !part.hull.vertices_O.empty() || has_hull(part.primitive.kind);
  });
  if (parts.size() > kMaxBodyParts || !are_good) {
    return false;
  }
  for (const BodyPart& part : parts) {
    part_hulls_[part_count_] = part.hull;
    if (part.hull.vertices_O.empty()) {
      primitive_parts_[part_count_].make(part.primitive);
      part_hulls_[part_count_] = primitive_parts_[part_count_].hull();
    }
    ++part_count_;
  }
  return true;
}

bool WorldBodies::add_body(const ObjectBody& body, const ConvexHull& hull,
                           const ContactSurface& surface) {
  if (body.first_part > part_count_ || body.part_count > part_count_ - body.first_part) {
    return false;
  }
  BodyStart start{
      .body = body,
      .parts = std::span<const ConvexHull>(part_hulls_).subspan(body.first_part, body.part_count),
      .surface = surface,
      .X_WO = {}};
  start.body.hull = hull;
  return bodies_.add_body(start);
}

void WorldBodies::wake(std::uint32_t object) {
  if (const std::size_t number = number_of(object); number < bodies_.bodies().size()) {
    bodies_.wake(number);
  }
}

std::size_t WorldBodies::number_of(std::uint32_t object) const {
  const auto numbers = std::span(body_objects_).first(bodies_.bodies().size());
  return static_cast<std::size_t>(std::ranges::find(numbers, object) - numbers.begin());
}

const RigidBody* WorldBodies::of(std::uint32_t object) const {
  const std::size_t number = number_of(object);
  return number < bodies_.bodies().size() ? &bodies_.bodies()[number] : nullptr;
}

double WorldBodies::work_by_hands_J(std::uint32_t object) const {
  const std::size_t number = number_of(object);
  return number < bodies_.bodies().size() ? work_by_hands_J_[number] : 0.0;
}

void WorldBodies::place(SceneObjects& scene) const {
  for (std::size_t i = 0; i < bodies_.bodies().size(); ++i) {
    const RigidBody& body = bodies_.bodies()[i];
    scene.set_pose(body_objects_[i], body.pose(), body.twist());
  }
}

void WorldBodies::step(const SceneObjects& scene, std::span<ToolGrips> tools) {
  for (std::size_t i = 0; i < obstacle_count_; ++i) {
    if (const Mover* const mover = scene.mover_of(obstacle_objects_[i]); mover != nullptr) {
      const bool moves = mover->moved || mover->twist.linear_W != Vec3::Zero() ||
                         mover->twist.angular_W != Vec3::Zero();
      bodies_.set_obstacle(i, mover->X_WO, mover->twist, moves);
    }
  }
  std::array<FingerGrip, kMostGrips> grips;
  std::array<Vec3, kMostGrips> forces_W;
  std::array<RigidPose, kMostGrips> before;
  std::size_t count = 0;
  for (std::size_t i = 0; i < tools.size(); ++i) {
    for (const ToolGrip& grip : std::span(tools[i].grips).first(tools[i].count)) {
      grips[count] = grip.grip;
      grips[count].tool = static_cast<std::uint32_t>(i);
      grips[count].body = static_cast<std::uint32_t>(number_of(grip.object));
      before[count] = bodies_.bodies()[grips[count].body].pose();
      ++count;
    }
  }
  bodies_.step(scene.tick_s(), std::span(grips).first(count), std::span(forces_W).first(count));
  work_by_hands_J_.fill(0.0);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t body = grips[i].body;
    work_by_hands_J_[body] +=
        work_on_body_J(-forces_W[i], grips[i].point_W, before[i], bodies_.bodies()[body].pose());
  }
  count = 0;
  for (ToolGrips& tool : tools) {
    for (ToolGrip& grip : std::span(tool.grips).first(tool.count)) {
      grip.force_W = forces_W[count++];
    }
  }
}

}  // namespace tactus::rendering
