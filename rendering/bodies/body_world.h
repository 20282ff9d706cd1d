// The bodies of a world that move by forces: what fingers, gravity and contacts do to them in a
// tick. World owns one.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "rendering/bodies/body_contact.h"
#include "rendering/bodies/field_contact.h"
#include "rendering/bodies/finger_grip.h"
#include "rendering/bodies/mesh_contact.h"
#include "rendering/bodies/placed_hull.h"
#include "rendering/bodies/rigid_body.h"
#include "rendering/bodies/solver_body.h"
#include "rendering/geometry/mesh.h"
#include "rendering/geometry/vector.h"
#include "rendering/limits.h"
#include "rendering/state_archive.h"

namespace tactus::rendering {

// A body to be added: its description, with the hull whatever its surface is, and its surface.
struct BodyStart {
  ObjectBody body;
  ContactSurface surface;
  // The pose of the object at the start.
  RigidPose X_WO;
};

// An object that bodies meet and cannot push: a mesh, a field, a hull, or a half space below a
// plane.
struct BodyObstacle {
  // The mesh and the sides of it that stop bodies; frame O.
  MeshView mesh;
  Sides sides = Sides::one;
  // The surface by its distance, where there is no mesh.
  ObstacleField field;
  // The hull, where there is neither. Without vertices it is the half space y <= 0 of a frame whose
  // pose in O is given.
  ConvexHull hull;
  RigidPose plane_O;
  ContactSurface surface;
  RigidPose X_WO;
  Twist twist;
};

// Lives in static storage; no heap. The time of a step is bounded by the numbers of bodies,
// obstacles and contacts.
//
// A tick is solved in sub-steps, each of which (Catto, "Solver2D", 2024) accelerates the bodies,
// starts with the impulses of the last one, solves every contact once with soft recovery from
// overlaps, moves the bodies, and solves every contact again without recovery, so that recovery
// gives no energy. Restitution comes last. The order is that of the bodies' numbers.
class BodyWorld {
 public:
  // Starts over without bodies, with fingers that touch in a point.
  void clear();
  // Adds a body or an obstacle, after clear(). Returns false, and adds nothing, if there are
  // kMaxBodies or kMaxObstacles already, or the mass is not valid() or the hull has no or too many
  // vertices. Its views must stay alive and unchanged.
  bool add_body(const BodyStart& start);
  bool add_obstacle(const BodyObstacle& obstacle);
  // Sets the gravity, m/s^2; zero by default.
  void set_gravity(const Vec3& gravity_W) { gravity_W_ = gravity_W; }
  // Makes the fingers soft (finger_grip.h), with this yield, m^3/N; 0: points.
  void set_soft_fingers(double yield_m3_per_N) { grips_.clear(yield_m3_per_N); }

  // Sets the place of an obstacle that moves, from the next step on.
  void set_obstacle(std::size_t obstacle, const RigidPose& X_WO, const Twist& twist);

  // Computes one tick of `tick_s` > 0 with what fingers do in it, and writes the force of each grip
  // on the hand to `forces_W`: minus the sum of its impulses on the body, over the tick, N. Forces
  // have as many places as grips.
  void step(double tick_s, std::span<const FingerGrip> grips, std::span<Vec3> forces_W);

  // Returns the bodies, in the order in which they were added.
  [[nodiscard]] std::span<const RigidBody> bodies() const { return {bodies_.data(), body_count_}; }
  // Returns true if the last step had more than kMaxBodyContacts, and left out the last ones, or
  // found more than kMaxNearTriangles of a mesh near a body.
  [[nodiscard]] bool has_left_out_contacts() const { return left_out_; }

  // Returns the number of contact points of the last step.
  [[nodiscard]] std::size_t point_count() const;

  // Saves the state to the archive, or restores it; bodies and obstacles must be the same.
  void transfer(StateArchive& archive);

 private:
  // Finds the contacts of this tick, and takes over the impulses of the last.
  void find_contacts(double tick_s);
  // Finds the contacts of body b with a body, or with an obstacle, that its surface may reach
  // within the margin.
  void find_contacts_with(std::uint16_t a, std::uint16_t b, double margin_m);
  // Adds the contact of a manifold; it is in the world frame, or in a frame whose pose is given.
  void add_contact(std::uint16_t a, std::uint16_t b, const Manifold& manifold);
  void add_contact(std::uint16_t a, std::uint16_t b, Manifold manifold, const RigidPose& X_WO);
  // Computes one sub-step; the last one has the bounces.
  void sub_step(double step_s, bool is_last);
  // Solves all contacts, with recovery from overlaps or without (nullptr).
  void solve_contacts(double step_s, const ContactSoftness* softness);
  // Sums up the impulses on the bodies in this sub-step.
  void sum_impulses();
  // Moves the bodies by the velocities that are solved so far.
  void move_bodies(double step_s);

  // Solids are numbered: first the bodies, then the obstacles.
  static constexpr std::size_t kMostSolids = kMaxBodies + kMaxObstacles;

  std::array<BodyStart, kMaxBodies> starts_;
  std::array<RigidBody, kMaxBodies> bodies_;
  std::size_t body_count_ = 0;
  std::array<BodyObstacle, kMaxObstacles> obstacles_;
  std::size_t obstacle_count_ = 0;
  Vec3 gravity_W_ = Vec3::Zero();

  std::array<BodyContact, kMaxBodyContacts> contacts_;
  std::size_t contact_count_ = 0;
  bool left_out_ = false;

  // Members that live for a step only.
  std::array<PastContact, kMaxBodyContacts> contacts_before_;
  std::size_t contact_count_before_ = 0;
  std::array<PlacedHull, kMostSolids> hulls_;
  std::array<SolverBody, kMostSolids> solids_;
  std::array<Shift, kMostSolids> shifts_;
  std::array<Vec6, kMostSolids> pushed_;
  std::array<Vec6, kMaxBodies> moved_;
  MeshContact mesh_contact_;
  FieldContact field_contact_;
  // A body, seen from the obstacle.
  PlacedHull seen_;
  FingerGrips grips_;
};

}  // namespace tactus::rendering
