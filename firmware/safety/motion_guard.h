// Finds a tool that is too fast or runs away, and slows it. One thread; real time.
//
//  - limiting_speed: from max_tool_speed / 2 on, force along the motion is taken away, linearly up
//    to all of it at max_tool_speed. So the device does not drive the hand faster.
//  - overspeed: |v| > max_tool_speed.
//  - motion_without_torque: the tool moves by runaway_travel_m faster than runaway_speed, and the
//    commanded force does not push it that way. An encoder whose direction flipped turns every
//    force into this, and so does a drive that makes torque of its own.
#pragma once

#include <cstdint>

#include "firmware/configuration/controller_config.h"
#include "rendering/geometry/vector.h"
#include "rendering/state_archive.h"

namespace tactus::firmware {

// A force and the limits that acted on it.
struct SlowedForce {
  Vec3 force_W = Vec3::Zero();  // N
  // FaultBits.
  std::uint64_t limits = 0;
};

// The guard of one tool.
class MotionGuard {
 public:
  // Takes rate and thresholds, and rests.
  void configure(const ControllerConfig& config);

  // Sets the distance that the tool has run away to 0. Call when the tool's position starts anew.
  void rest() { runaway_m_ = 0.0; }

  // Returns the FaultBits of a finite velocity, m/s. `held_W` is the force commanded by the
  // previous tick, N.
  std::uint64_t check(const Vec3& v_W, const Vec3& held_W);

  // Returns the force after the speed limit. Both arguments are finite, N and m/s.
  [[nodiscard]] SlowedForce slow(const Vec3& force_W, const Vec3& v_W) const;

  // Writes its memory to the archive, or reads it back.
  void transfer(rendering::StateArchive& archive);

 private:
  double step_s_ = 0.001;
  double max_speed_m_per_s_ = 0.0;
  double runaway_speed_m_per_s_ = 0.0;
  double runaway_travel_m_ = 0.0;
  // The distance that the tool has run away without a push, m.
  double runaway_m_ = 0.0;
};

}  // namespace tactus::firmware
