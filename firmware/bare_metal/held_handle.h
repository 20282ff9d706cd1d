// A simulated device with the hand that holds it, for a board that has neither: any mechanism of a
// device image, in memory of fixed size, by portable arithmetic alone, so that a board and a
// desktop compute the same bits. It satisfies drivers::Device.
//
// It fakes the following. Each joint turns or slides by itself, with the inertia that the handle's
// mass has there at that moment; the coupling between joints is left out. Joints have viscous
// friction. Encoders have no steps, motors no delay and no limit, and the device is at its
// reference when it wakes up. The hand is a spring and a damper to a wished position and does not
// tremble.
#pragma once

#include <cstddef>
#include <cstdint>

#include "drivers/device.h"
#include "firmware/configuration/controller_config.h"
#include "firmware/device_file/device_config.h"
#include "firmware/kinematics/mechanism.h"
#include "rendering/geometry/vector.h"

namespace tactus::firmware {

// A device that lives in its calls of `read`: each one lets a tick of time pass. One thread; real
// time.
class HeldHandle {
 public:
  // Places the joints at their references, at rest. The mechanism, its weights, the rate and the
  // world's origin are those of the device.
  void start(const DeviceConfig& device);

  // The next four functions are those of drivers::Device.
  [[nodiscard]] std::size_t joint_count() const { return joint_count_; }
  // Advances the simulation by a tick, and copies its state.
  void read(drivers::JointSample& sample);
  // Takes the efforts for the next tick.
  std::uint32_t write(const drivers::JointCommand& command);
  void clear_faults() {}

 private:
  // The wish of the hand during a tick: a position, m, and a velocity, m/s.
  struct Wish {
    Vec3 p_D = Vec3::Zero();
    Vec3 v_D = Vec3::Zero();
  };

  // Returns the wished position at a tick, m. In the first second it leaves the place of the start.
  [[nodiscard]] Vec3 wish_D(std::uint64_t tick) const;
  // Advances by a part of a tick.
  void step(const Wish& wish, double step_s);

  std::size_t joint_count_ = 0;
  Mechanism mechanism_;
  double tick_s_ = 0.001;
  Vec3 origin_D_ = Vec3::Zero();
  Vec3 gravity_D_ = Vec3::Zero();
  // The position of the tool at the start, m.
  Vec3 start_D_ = Vec3::Zero();

  std::uint64_t tick_ = 0;
  Vec3 position_ = Vec3::Zero();
  Vec3 velocity_ = Vec3::Zero();
  Vec3 effort_ = Vec3::Zero();
  // The tool's last position, m: where an iterating mechanism begins.
  Vec3 p_D_ = Vec3::Zero();
};

static_assert(drivers::Device<HeldHandle>);

}  // namespace tactus::firmware
