// The bodies of a world that move by forces: what fingers, gravity and contacts do to them in a
// tick. World owns one.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "rendering/bodies/awake_bodies.h"
#include "rendering/bodies/body_sleep.h"
#include "rendering/bodies/body_solver.h"
#include "rendering/bodies/contact_list.h"
#include "rendering/bodies/finger_grip.h"
#include "rendering/bodies/rigid_body.h"
#include "rendering/bodies/solid_hulls.h"
#include "rendering/bodies/solid_list.h"
#include "rendering/bodies/solid_meeting.h"
#include "rendering/geometry/vector.h"
#include "rendering/limits.h"
#include "rendering/state_archive.h"

namespace tactus::rendering {

// Lives in static storage; no heap. The time of a step is bounded by the numbers of bodies,
// obstacles and contacts. A step finds out who is awake and who meets whom, solves the contacts
// (body_solver.h), and lets bodies that are at rest fall asleep.
class BodyWorld {
 public:
  // Starts over without bodies, with fingers that touch in a point.
  void clear();
  // Adds a body or an obstacle, after clear(); solid_list.h says which are refused.
  bool add_body(const BodyStart& start) { return solids_.add_body(start); }
  bool add_obstacle(const BodyObstacle& obstacle) { return solids_.add_obstacle(obstacle); }
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
                    bool moves = true) {
    solids_.set_obstacle(obstacle, X_WO, twist, moves);
  }

  // Computes one tick of `tick_s` > 0 with what fingers do in it, and writes the force of each grip
  // on the hand to `forces_W`: minus the sum of its impulses on the body, over the tick, N. Forces
  // have as many places as grips.
  void step(double tick_s, std::span<const FingerGrip> grips, std::span<Vec3> forces_W);

  // Returns the bodies, in the order in which they were added.
  [[nodiscard]] std::span<const RigidBody> bodies() const { return solids_.bodies(); }
  // Returns true if a body sleeps: it is where it was, at rest.
  [[nodiscard]] bool is_asleep(std::size_t body) const { return sleep_.is_asleep(body); }
  // Returns true if the last step had more than kMaxBodyContacts, and left out the last ones, or
  // found more than kMaxNearTriangles of a mesh near a body.
  [[nodiscard]] bool has_left_out_contacts() const { return contacts_.has_left_out(); }

  // Returns the number of contact points of the last step.
  [[nodiscard]] std::size_t point_count() const;

  // Saves the state to the archive, or restores it; bodies and obstacles must be the same.
  void transfer(StateArchive& archive);

 private:
  // For each solid how far it may move in the tick, m.
  using Margins = std::array<double, SolidList::kMostSolids>;

  // Computes a tick with the bodies that are awake; some may wake in it.
  void step_awake(double tick_s, std::span<const FingerGrip> grips);

  // Finds the contacts of this tick.
  void find_contacts(double tick_s);
  // Adds the contacts of body b with a solid that its surface may reach within the margin.
  void add_contacts(std::uint16_t a, std::uint16_t b, double margin_m);
  // Places the hull of a solid that has one, and returns how far it may move in the tick, m.
  double place_hull(std::uint16_t solid, double tick_s);
  // Returns the margin within which two solids may meet in this tick, m.
  [[nodiscard]] double margin_of(std::uint16_t a, std::uint16_t b, double tick_s,
                                 const Margins& margins);

  // Returns true if no body is awake and nothing moves that could wake one.
  [[nodiscard]] bool is_all_asleep() const {
    return awake_.numbers().empty() && !solids_.any_obstacle_moves();
  }
  // Wakes the bodies that bodies awake, or obstacles that move, touch.
  void wake_neighbours(double tick_s, Margins& margins);
  // Returns true if the solid touches a body that sleeps, or will in this tick.
  bool wakes(std::uint16_t solid, std::uint16_t sleeper, double tick_s, const Margins& margins);
  // Lets the bodies fall asleep that have been at rest long enough.
  void rest_bodies(double tick_s, std::span<const FingerGrip> grips);

  SolidList solids_;
  SolidHulls hulls_;
  SolidMeeting meeting_;
  ContactList contacts_;
  BodySolver solver_;
  FingerGrips grips_;
  BodySleep sleep_;
  AwakeBodies awake_;
  Vec3 gravity_W_ = Vec3::Zero();
};

}  // namespace tactus::rendering
