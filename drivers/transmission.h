// From the shafts of a motor and its encoder to the joint that they move, and back: gears,
// capstans, directions and where the joint is when the encoder reads zero.
//
// A joint is in rad and N m where it turns, in m and N where it slides; shafts are in rad and N m.
// Ideal: no play, no give, no losses. Pure functions, for any thread.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

namespace tactus::drivers {

// A ratio is how far the shaft turns (rad) for one unit of the joint. Where the joint turns that is
// the gear's or the capstan's: body radius / capstan radius. Where it slides on a drum of radius r
// it is 1 / r, on a screw of lead h 2 pi / h. Motor and encoder are told apart because an encoder
// may sit at the joint; where both are on one shaft, both have the same ratio and direction.
struct Transmission {
  double motor_ratio = 1.0;
  double encoder_ratio = 1.0;
  double motor_direction = 1.0;    // 1, or -1 where the joint moves against the motor
  double encoder_direction = 1.0;  // 1, or -1 where the joint moves against the encoder
  double offset = 0.0;             // the joint's position where the encoder's shaft is at 0
};

// Ratios positive, directions 1 or -1, all finite. The functions below need it.
inline bool is_valid(const Transmission& t) {
  const auto ratio = [](double value) { return value > 0.0 && std::isfinite(value); };
  const auto direction = [](double value) { return value == 1.0 || value == -1.0; };
  return ratio(t.motor_ratio) && ratio(t.encoder_ratio) && direction(t.motor_direction) &&
         direction(t.encoder_direction) && std::isfinite(t.offset);
}

// Of an encoder with `counts_per_turn` counts a turn of its own shaft, all edges counted: four
// times its lines.
inline double shaft_rad(std::int64_t counts, double counts_per_turn) {
  return static_cast<double>(counts) * (2.0 * std::numbers::pi / counts_per_turn);
}

// The nearest count, as an ideal encoder would show it.
inline std::int64_t shaft_counts(double shaft_rad, double counts_per_turn) {
  return std::llround(shaft_rad * (counts_per_turn / (2.0 * std::numbers::pi)));
}

inline double joint_velocity(const Transmission& t, double encoder_rad_per_s) {
  return t.encoder_direction * encoder_rad_per_s / t.encoder_ratio;
}

inline double joint_position(const Transmission& t, double encoder_rad) {
  return t.offset + joint_velocity(t, encoder_rad);
}

inline double encoder_position_rad(const Transmission& t, double joint_position) {
  return t.encoder_direction * t.encoder_ratio * (joint_position - t.offset);
}

// By virtual work: effort . joint motion = torque . motor motion.
inline double joint_effort(const Transmission& t, double motor_torque_Nm) {
  return t.motor_direction * t.motor_ratio * motor_torque_Nm;
}

inline double motor_torque_Nm(const Transmission& t, double joint_effort) {
  return t.motor_direction * joint_effort / t.motor_ratio;
}

// The offset that makes the joint be at a known position now: homing by an index, a hard stop or a
// pose that the user holds.
inline double offset_at(const Transmission& t, double encoder_rad, double known_position) {
  return known_position - joint_velocity(t, encoder_rad);
}

}  // namespace tactus::drivers
