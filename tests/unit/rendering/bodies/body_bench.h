// A world of bodies for tests: planes, meshes, boxes and balls, and gravity.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include <Eigen/Dense>

#include "rendering/bodies/body_world.h"
#include "rendering/bodies/primitive_hull.h"
#include "tests/support/shapes.h"
#include "tests/support/solid.h"

namespace tactus::rendering {

inline constexpr double kBodyGravity_m_per_s2 = 9.80665;
inline constexpr double kBodyTick_s = 1e-3;

inline Mat3 body_turned(const Vec3& axis, double angle_rad) {
  return Eigen::AngleAxisd(angle_rad, axis.normalized()).toRotationMatrix();
}

inline BodyMass mass_of_box(double mass_kg, const Vec3& half) {
  const Vec3 square = half.cwiseProduct(half);
  const Vec3 moments =
      mass_kg / 3.0 *
      Vec3(square.y() + square.z(), square.x() + square.z(), square.x() + square.y());
  return {.mass_kg = mass_kg, .inertia_C = moments.asDiagonal()};
}

inline BodyMass mass_of_ball(double mass_kg, double radius) {
  return {.mass_kg = mass_kg, .inertia_C = 0.4 * mass_kg * radius * radius * Mat3::Identity()};
}

// Keeps the hulls of a world alive.
class BodyBench {
 public:
  BodyBench() : world_(std::make_unique<BodyWorld>()) {
    world_->clear();
    world_->set_gravity(Vec3(0.0, -kBodyGravity_m_per_s2, 0.0));
    hulls_.reserve(kMaxBodies);
  }

  void add_plane(const Vec3& normal, double friction) {
    RigidPose pose;
    const Vec3 along = normal.unitOrthogonal();
    pose.rotation << along, normal, along.cross(normal);
    ASSERT_TRUE(world_->add_obstacle({.surface = {.friction = friction}, .X_WO = pose}));
  }

  // Adds a mesh, which stays alive with the bench, at rest in the world; one-sided unless said.
  void add_mesh(testing::Shape shape, double friction, Sides sides = Sides::one) {
    meshes_.push_back(std::make_unique<testing::Solid>(std::move(shape), sides, Material{}));
    ASSERT_TRUE(world_->add_obstacle({.mesh = meshes_.back()->object().mesh,
                                      .sides = sides,
                                      .surface = {.friction = friction}}));
  }

  void add(const Primitive& primitive, const BodyMass& mass, const RigidPose& pose,
           const ContactSurface& surface, const Vec3& velocity = Vec3::Zero(),
           const Vec3& angular_velocity = Vec3::Zero()) {
    hulls_.push_back(std::make_unique<PrimitiveHull>());
    hulls_.back()->make(primitive);
    ASSERT_TRUE(world_->add_body({.body = {.mass = mass,
                                           .hull = hulls_.back()->hull(),
                                           .velocity_W = velocity,
                                           .angular_velocity_O = angular_velocity},
                                  .surface = surface,
                                  .X_WO = pose}));
  }
  // Adds a body of several parts, which are placed in its frame.
  void add_compound(const std::vector<Primitive>& parts, const BodyMass& mass,
                    const RigidPose& pose, const ContactSurface& surface,
                    const Vec3& velocity = Vec3::Zero()) {
    std::vector<ConvexHull>& hulls =
        *compounds_.emplace_back(std::make_unique<std::vector<ConvexHull>>());
    for (const Primitive& part : parts) {
      hulls_.push_back(std::make_unique<PrimitiveHull>());
      hulls_.back()->make(part);
      hulls.push_back(hulls_.back()->hull());
    }
    ASSERT_TRUE(world_->add_body({.body = {.mass = mass, .velocity_W = velocity},
                                  .parts = hulls,
                                  .surface = surface,
                                  .X_WO = pose}));
  }
  void add_box(const Vec3& half, double mass_kg, const RigidPose& pose, double friction,
               const Vec3& velocity = Vec3::Zero()) {
    add({.kind = PrimitiveKind::box, .dimensions_m = {half.x(), half.y(), half.z()}},
        mass_of_box(mass_kg, half), pose, {.friction = friction}, velocity);
  }
  void add_ball(double radius, double mass_kg, const Vec3& center, const ContactSurface& surface,
                const Vec3& velocity = Vec3::Zero(), const Vec3& angular_velocity = Vec3::Zero()) {
    add({.kind = PrimitiveKind::sphere, .dimensions_m = {radius}}, mass_of_ball(mass_kg, radius),
        {.translation = center}, surface, velocity, angular_velocity);
  }

  void run(double seconds) {
    for (int i = 0; i < static_cast<int>(std::lround(seconds / kBodyTick_s)); ++i) {
      world_->step(kBodyTick_s, {}, {});
    }
  }
  [[nodiscard]] const RigidBody& body(std::size_t i) const { return world_->bodies()[i]; }
  [[nodiscard]] std::size_t bodies() const { return world_->bodies().size(); }
  BodyWorld& world() { return *world_; }

 private:
  std::unique_ptr<BodyWorld> world_;
  std::vector<std::unique_ptr<PrimitiveHull>> hulls_;
  std::vector<std::unique_ptr<std::vector<ConvexHull>>> compounds_;
  std::vector<std::unique_ptr<testing::Solid>> meshes_;
};

// A box on a plane that is inclined by `angle` about z, with its base on it.
struct BodySlope {
  double angle;
  Vec3 normal{-std::sin(angle), std::cos(angle), 0.0};
  Vec3 down{-std::cos(angle), -std::sin(angle), 0.0};
  [[nodiscard]] RigidPose box_at(double half_height) const {
    return {.rotation = body_turned(Vec3::UnitZ(), angle), .translation = half_height * normal};
  }
};

}  // namespace tactus::rendering
