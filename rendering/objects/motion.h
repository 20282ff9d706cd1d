// A motion that a scene gives an object: straight, to and fro, in rotation, and in waves over its
// surface. It ends when the outside sets the object (World::set_pose, World::move_vertex). Movers
// (movers.h) asks for the place in every tick.
#pragma once

#include "rendering/geometry/portable_math.h"
#include "rendering/geometry/rigid_pose.h"
#include "rendering/geometry/vector.h"

namespace tactus::rendering {

// The velocity of a body's origin, and its angular velocity; world frame.
struct Twist {
  Vec3 linear_W = Vec3::Zero();   // m/s
  Vec3 angular_W = Vec3::Zero();  // rad/s

  // Returns the velocity of a body's point, m/s. `from_origin_W` leads from the body's origin to
  // it, m.
  [[nodiscard]] Vec3 at(const Vec3& from_origin_W) const {
    return linear_W + angular_W.cross(from_origin_W);
  }
};

// The motion of one object, at the time t: its origin moves by velocity t + sway sin(2 pi sway_Hz
// t), and the object turns about an axis through the pivot, which moves along.
struct Motion {
  // The steady velocity, m/s.
  Vec3 velocity_W = Vec3::Zero();
  // The farthest point of going to and fro, m from the middle.
  Vec3 sway_W = Vec3::Zero();
  // The frequency of that, Hz.
  double sway_Hz = 0.0;
  // The angular velocity, rad/s.
  Vec3 spin_W = Vec3::Zero();
  // A point of the axis of the spin at the start, m.
  Vec3 pivot_W = Vec3::Zero();
  // The waves of a mesh that deforms: a point p of the surface moves by wave_m sin(2 pi (wave_Hz t
  // - k . p)) along its normal, both as they are at rest.
  double wave_m = 0.0;
  double wave_Hz = 0.0;
  // The wave vector k, waves a metre.
  Vec3 wave_per_m = Vec3::Zero();
};

// Returns true if every number is finite, frequencies are not negative and kWorldBound_m bounds the
// lengths.
bool valid(const Motion& motion);

// The place and the velocity of an object at one time.
struct Placement {
  RigidPose X_WO;
  Twist twist;
};

// Returns the placement at t_s >= 0; at 0 an object is where the scene puts it. The bits are the
// same on every machine.
Placement place_at(const Motion& motion, double t_s);

// The angle of the wave at a point that is at rest_O: 2 pi k . rest_O.
SineCosine wave_angle(const Motion& motion, const Vec3& rest_O);
// The angle of the wave at a time, 2 pi wave_Hz t_s, which all points share.
SineCosine wave_angle(const Motion& motion, double t_s);
// Returns how far a point of the surface is from rest along its normal, m, from both angles: wave_m
// times the sine of their difference.
inline double wave_at(const Motion& motion, const SineCosine& of_place, const SineCosine& of_time) {
  return motion.wave_m * (of_time.sine * of_place.cosine - of_time.cosine * of_place.sine);
}

}  // namespace tactus::rendering
