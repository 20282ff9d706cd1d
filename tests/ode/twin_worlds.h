// The same scene in BodyWorld and in the Open Dynamics Engine, tick by tick.
#pragma once

#include <string_view>

#include "rendering/surface/primitive.h"
#include "tests/ode/ode_world.h"
#include "tests/unit/rendering/bodies/body_bench.h"

namespace tactus::testing {

// The largest differences of the bodies' places, m, and of their rotations, rad.
struct Difference {
  double place_m = 0.0;
  double turn_rad = 0.0;
};

// A finger that sticks to a body's point: its spring, N/m, and damper, Ns/m, the place and the
// velocity of its tool at the beginning of a tick; the outward normal of the surface there.
struct TwinFinger {
  double stiffness_N_per_m = 0.0;
  double damping_Ns_per_m = 0.0;
  Vec3 tool_W = Vec3::Zero();
  Vec3 tool_v_W = Vec3::Zero();
  Vec3 normal_W = Vec3::UnitY();
};

// A scene in both engines.
class TwinWorlds {
 public:
  struct Setting {
    Vec3 gravity_W{0.0, -rendering::kBodyGravity_m_per_s2, 0.0};
    // The surfaces of contacts with planes, and of those of two bodies; the restitution is one.
    double friction_on_planes = 0.0;
    double friction_of_bodies = 0.0;
    double restitution = 0.0;
    // The steps of ODE in a tick, and their sweeps (ode_world.h).
    int steps_in_tick = 50;
    int sweeps = 0;
  };
  explicit TwinWorlds(const Setting& setting);

  // Adds the half space below a plane through the origin.
  void add_plane(const Vec3& normal_W);
  void add(const OdeBody& body);

  // Computes so many seconds in both, and returns the largest differences after any of the ticks.
  Difference run(double seconds);
  // Computes a tick in both, in which a finger holds a body at a point of it (axes and centre of
  // the body, m) by a spring, while its tool moves evenly.
  void hold(std::size_t body, const Vec3& point_O, const TwinFinger& finger);
  // Returns the differences now.
  [[nodiscard]] Difference difference() const;

  [[nodiscard]] const rendering::RigidBody& body(std::size_t i) const { return bench_.body(i); }
  [[nodiscard]] const OdeWorld& ode() const { return ode_; }

 private:
  Setting setting_;
  rendering::BodyBench bench_;
  OdeWorld ode_;
};

// Prints a line of the table of differences.
void print_difference(std::string_view scene, double seconds, const Difference& difference);
// Computes so many seconds in both, prints a line of the table of differences, and fails where they
// are larger than the limit.
void expect_alike(std::string_view scene, TwinWorlds& worlds, double seconds,
                  const Difference& limit);

// A step of h begins to move with the velocity of its end (symplectic Euler), so that a body with a
// steady acceleration is ahead by h / 2 times its gain of velocity. Returns the difference that
// this makes between the engines, m.
double ahead_m(double acceleration_m_per_s2, double seconds);

// A body of each kind: a box by its half sides, a ball, and a capsule or a cylinder along y by its
// radius and half of its axis; their densities are even, but for the capsule's.
OdeBody box_body(const Vec3& half_m, double mass_kg, const rendering::RigidPose& pose = {},
                 const Vec3& velocity_W = Vec3::Zero(), const Vec3& turn_O = Vec3::Zero());
OdeBody ball_body(double radius_m, double mass_kg, const Vec3& center_W,
                  const Vec3& velocity_W = Vec3::Zero());
OdeBody round_body(rendering::PrimitiveKind kind, double radius_m, double half_m, double mass_kg,
                   const rendering::RigidPose& pose);

}  // namespace tactus::testing
