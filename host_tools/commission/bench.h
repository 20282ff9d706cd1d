// The interface between the checks of commissioning and a device with the person beside it.
// board_bench.h implements it with real boards, simulated_bench.h with the simulation.
#pragma once

#include <string>
#include <string_view>

#include "drivers/device.h"

namespace tactus::host {

// A task for the person beside the device.
enum class HandTask : std::uint8_t {
  // Bring each joint to its reference and hold it there until the joints are homed.
  hold_for_homing,
  // Move the handle to every end of its travel, while the motors have no power.
  move_everywhere,
  // Leave the handle alone.
  let_go,
};

// A device that runs at its loop's rate. A tick is one call of read(), one of write(), then wait().
// All functions may throw InputError.
class Bench {
 public:
  Bench() = default;
  Bench(const Bench&) = delete;
  Bench& operator=(const Bench&) = delete;
  virtual ~Bench() = default;

  // Reads positions, velocities and status of all joints.
  virtual void read(drivers::JointSample& sample) = 0;
  // Commands efforts, N m or N; a command without `enable` takes the motors' power away.
  virtual void write(const drivers::JointCommand& command) = 0;
  // Sleeps until the next tick.
  virtual void wait() = 0;
  // Asks the person for a task and returns at once.
  virtual void ask(HandTask task) = 0;
  // Returns true while the task goes on; the person says when it is done.
  virtual bool is_at_work(HandTask task) = 0;
  // Returns the device's own words about its fault; empty if it has none.
  [[nodiscard]] virtual std::string trouble() const = 0;
};

}  // namespace tactus::host
