// The bodies of a world that move by forces: what fingers, gravity and contacts do to them in a
// tick. World owns one.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "rendering/bodies/body_contact.h"
#include "rendering/bodies/body_sleep.h"
#include "rendering/bodies/field_contact.h"
#include "rendering/bodies/finger_grip.h"
#include "rendering/bodies/joined_manifolds.h"
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
  // The convex parts by which it meets others, instead of the hull; none for a body of one.
  std::span<const ConvexHull> parts;
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
  // vertices, or there are more than kMaxPartsOfBody or kMaxBodyParts. Its views must stay alive
  // and unchanged.
  bool add_body(const BodyStart& start);
  bool add_obstacle(const BodyObstacle& obstacle);
  // Sets the gravity, m/s^2; zero by default. All bodies wake.
  void set_gravity(const Vec3& gravity_W) {
    gravity_W_ = gravity_W;
    sleep_.wake_all();
  }
  // Lets bodies fall asleep after so long a rest, s (body_sleep.h); 0: never, as by default.
  void set_sleep(double after_s) { sleep_.start(after_s); }
  // Wakes a body with its island.
  void wake(std::size_t body) { sleep_.wake(body); }
  // Makes the fingers soft (finger_grip.h), with this yield, m^3/N; 0: points.
  void set_soft_fingers(double yield_m3_per_N) { grips_.clear(yield_m3_per_N); }

  // Sets the place of an obstacle from the next step on. It wakes the bodies that it touches if
  // `moves`.
  void set_obstacle(std::size_t obstacle, const RigidPose& X_WO, const Twist& twist,
                    bool moves = true);

  // Computes one tick of `tick_s` > 0 with what fingers do in it, and writes the force of each grip
  // on the hand to `forces_W`: minus the sum of its impulses on the body, over the tick, N. Forces
  // have as many places as grips.
  void step(double tick_s, std::span<const FingerGrip> grips, std::span<Vec3> forces_W);

  // Returns the bodies, in the order in which they were added.
  [[nodiscard]] std::span<const RigidBody> bodies() const { return {bodies_.data(), body_count_}; }
  // Returns true if a body sleeps: it is where it was, at rest.
  [[nodiscard]] bool is_asleep(std::size_t body) const { return sleep_.is_asleep(body); }
  // Returns true if the last step had more than kMaxBodyContacts, and left out the last ones, or
  // found more than kMaxNearTriangles of a mesh near a body.
  [[nodiscard]] bool has_left_out_contacts() const { return left_out_; }

  // Returns the number of contact points of the last step.
  [[nodiscard]] std::size_t point_count() const;

  // Saves the state to the archive, or restores it; bodies and obstacles must be the same.
  void transfer(StateArchive& archive);

 private:
  // Solids are numbered: first the bodies, then the obstacles.
  static constexpr std::size_t kMostSolids = kMaxBodies + kMaxObstacles;
  // For each solid how far it may move in the tick, m.
  using Margins = std::array<double, kMostSolids>;

  // Computes a tick with the bodies that are awake; some may wake in it.
  void step_awake(double tick_s, std::span<const FingerGrip> grips);
  // Returns the numbers of the bodies that are awake in this step.
  [[nodiscard]] std::span<const std::uint8_t> awake() const {
    return {awake_.data(), awake_count_};
  }
  // Lists the bodies that are awake.
  void list_awake();
  // Prepares a body to be solved in this tick.
  void take_body(std::size_t body);
  // Returns true if a solid is an obstacle that moves in this tick.
  [[nodiscard]] bool is_moving_obstacle(std::size_t solid) const {
    return solid >= body_count_ && obstacle_moves_[solid - body_count_];
  }
  // Returns true if no body is awake and nothing moves that could wake one.
  [[nodiscard]] bool is_all_asleep() const;
  // Wakes the bodies that bodies awake, or obstacles that move, touch.
  void wake_neighbours(double tick_s, Margins& margins);
  // Returns true if the solid touches a body that sleeps, or will in this tick.
  bool wakes(std::uint16_t solid, std::uint16_t sleeper, double tick_s, const Margins& margins);
  // Lets the bodies fall asleep that have been at rest long enough.
  void rest_bodies(double tick_s, std::span<const FingerGrip> grips);

  // Finds the contacts of this tick.
  void find_contacts(double tick_s);
  // Keeps the contacts of the last tick for their impulses.
  void remember_contacts();
  // Places the hull of a solid that has one, and returns how far it may move in the tick, m.
  double place_hull(std::uint16_t solid, double tick_s);
  // Places the hull of a body, or its parts.
  void place_body(std::size_t body);
  // Returns the hulls of a solid: one, or those of a body's parts.
  [[nodiscard]] std::span<const PlacedHull> parts_of(std::size_t solid) const {
    const std::size_t parts = solid < body_count_ ? starts_[solid].parts.size() : 0;
    return parts == 0 ? std::span(hulls_).subspan(solid, 1)
                      : std::span(part_hulls_).subspan(first_part_[solid], parts);
  }
  // Returns true for a body, and for an obstacle that is met by a hull.
  [[nodiscard]] bool has_hull(std::uint16_t solid) const;
  // Returns the margin within which two solids may meet in this tick, m.
  [[nodiscard]] double margin_of(std::uint16_t a, std::uint16_t b, double tick_s,
                                 const Margins& margins) const;
  // Finds the contacts of body b with a body, or with an obstacle, that its surface may reach
  // within the margin.
  void find_contacts_with(std::uint16_t a, std::uint16_t b, double margin_m);
  // Joins the contacts of the parts of two solids with hulls.
  void join_parts(std::uint16_t a, std::uint16_t b, double margin_m);
  // Gives the manifolds of a hull of body b with an obstacle that has no hull to `take`.
  template <class Take>
  void meet_surface(std::uint16_t a, std::uint16_t b, const PlacedHull& hull_b, double margin_m,
                    const Take& take);
  // Adds the contact of a manifold in the world frame.
  void add_contact(std::uint16_t a, std::uint16_t b, const Manifold& manifold);
  // Returns true if fingers hold a body of a contact.
  [[nodiscard]] bool is_held(const BodyContact& contact) const {
    return grips_.holds(contact.a) || grips_.holds(contact.b);
  }
  // Solves the springs of the fingers for the impulses that the contacts have now.
  void hold_bodies();
  // Computes one sub-step; the last one has the bounces.
  void sub_step(double step_s, bool is_last);
  // Solves all contacts, with recovery from overlaps or without (nullptr).
  void solve_contacts(double step_s, const ContactSoftness* softness);
  // Bounces what has hit.
  void bounce();
  // Sums up the impulses on the bodies in this sub-step.
  void sum_impulses();
  // Moves the bodies by the velocities that are solved so far.
  void move_bodies(double step_s);

  std::array<BodyStart, kMaxBodies> starts_;
  std::array<RigidBody, kMaxBodies> bodies_;
  std::size_t body_count_ = 0;
  // The parts of a body in part_hulls_ begin with this number.
  std::array<std::uint16_t, kMaxBodies> first_part_{};
  std::size_t part_count_ = 0;
  std::array<BodyObstacle, kMaxObstacles> obstacles_;
  std::size_t obstacle_count_ = 0;
  Vec3 gravity_W_ = Vec3::Zero();

  std::array<BodyContact, kMaxBodyContacts> contacts_;
  std::size_t contact_count_ = 0;
  bool left_out_ = false;
  BodySleep sleep_;

  // Members that live for a step only.
  std::array<bool, kMaxObstacles> obstacle_moves_{};
  std::array<std::uint8_t, kMaxBodies> awake_{};
  std::size_t awake_count_ = 0;
  std::array<PastContact, 2 * kMaxBodyContacts> contacts_before_;
  std::size_t contact_count_before_ = 0;
  // The hulls of bodies that sleep stay where they are. The hull of a body of several parts has
  // their middle and their reach.
  std::array<PlacedHull, kMostSolids> hulls_;
  std::array<PlacedHull, kMaxBodyParts> part_hulls_;
  std::array<SolverBody, kMostSolids> solids_;
  std::array<Shift, kMostSolids> shifts_;
  std::array<Vec6, kMostSolids> pushed_;
  std::array<Vec6, kMaxBodies> moved_;
  // The impulses of contacts for which the springs of a body are solved.
  std::array<Vec6, kMaxBodies> held_against_;
  JoinedManifolds joined_;
  MeshContact mesh_contact_;
  FieldContact field_contact_;
  // A part of a body, seen from the obstacle.
  PlacedHull seen_;
  FingerGrips grips_;
};

}  // namespace tactus::rendering
