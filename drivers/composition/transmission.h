// Converts between a joint and the shafts of its motor and encoder. The conversion covers gears,
// capstans, directions and the joint's position when the encoder reads zero.
//
// A revolute joint is in rad and N m, a prismatic one in m and N; shafts are in rad and N m. The
// transmission is ideal: it has no play, no compliance and no losses. All are pure functions, for
// any thread.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

namespace tactus::drivers {

// A ratio is the turn of the shaft (rad) for one unit of the joint. For a revolute joint it is the
// ratio of the gear or of the capstan: body radius / capstan radius. For a slide on a drum of
// radius r it is 1 / r, on a screw of lead h it is 2 pi / h. Motor and encoder have ratios of their
// own because an encoder may sit at the joint. If both are on one shaft, both ratios and both
// directions are equal.
struct Transmission {
  double motor_ratio = 1.0;
  double encoder_ratio = 1.0;
  double motor_direction = 1.0;    // 1, or -1 if the joint moves against the motor
  double encoder_direction = 1.0;  // 1, or -1 if the joint moves against the encoder
  double offset = 0.0;             // position of the joint when the encoder's shaft is at 0
};

// Returns true if the ratios are positive, the directions are 1 or -1, and all values are finite.
// The functions below need a valid transmission.
inline bool is_valid(const Transmission& t) {
  const auto ratio = [](double value) { return value > 0.0 && std::isfinite(value); };
  const auto direction = [](double value) { return value == 1.0 || value == -1.0; };
  return ratio(t.motor_ratio) && ratio(t.encoder_ratio) && direction(t.motor_direction) &&
         direction(t.encoder_direction) && std::isfinite(t.offset);
}

// Returns the angle of an encoder's shaft, rad. `counts_per_turn` counts every edge, so it is four
// times the lines of the encoder.
inline double shaft_rad(std::int64_t counts, double counts_per_turn) {
  return static_cast<double>(counts) * (2.0 * std::numbers::pi / counts_per_turn);
}

// Returns the nearest count for an angle of the shaft, which an ideal encoder would show.
inline std::int64_t shaft_counts(double shaft_rad, double counts_per_turn) {
  return std::llround(shaft_rad * (counts_per_turn / (2.0 * std::numbers::pi)));
}

// Returns the joint's velocity, rad/s or m/s, for a velocity of the encoder's shaft.
inline double joint_velocity(const Transmission& t, double encoder_rad_per_s) {
  return t.encoder_direction * encoder_rad_per_s / t.encoder_ratio;
}

// Returns the joint's position, rad or m, for an angle of the encoder's shaft.
inline double joint_position(const Transmission& t, double encoder_rad) {
  return t.offset + joint_velocity(t, encoder_rad);
}

// Returns the angle of the encoder's shaft for a position of the joint.
inline double encoder_position_rad(const Transmission& t, double joint_position) {
  return t.encoder_direction * t.encoder_ratio * (joint_position - t.offset);
}

// These two convert efforts by virtual work: effort . joint motion = torque . motor motion.
inline double joint_effort(const Transmission& t, double motor_torque_Nm) {
  return t.motor_direction * t.motor_ratio * motor_torque_Nm;
}

inline double motor_torque_Nm(const Transmission& t, double joint_effort) {
  return t.motor_direction * joint_effort / t.motor_ratio;
}

// Returns the offset with which the joint is at `known_position` now. Homing uses it: at an index,
// at a hard stop, or in a pose that the user holds.
inline double offset_at(const Transmission& t, double encoder_rad, double known_position) {
  return known_position - joint_velocity(t, encoder_rad);
}

}  // namespace tactus::drivers
