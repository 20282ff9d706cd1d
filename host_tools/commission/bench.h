// The device under commissioning and the person beside it, as the checks see them.
#pragma once

#include <string>
#include <string_view>

#include "drivers/device.h"

namespace tactus::host {

// A task for the person beside the device.
enum class HandTask : std::uint8_t {
  hold_for_homing,  // brings the joints to where their references are, and lets them find these
  move_everywhere,  // moves the handle to every end of its travel, without motor power
  let_go,           // leaves the handle alone
};

// A device at its loop's rate. One call of `read`, one of `write`, then `wait` make a tick. May
// throw InputError, text for the user.
class Bench {
 public:
  Bench() = default;
  Bench(const Bench&) = delete;
  Bench& operator=(const Bench&) = delete;
  virtual ~Bench() = default;

  virtual void read(drivers::JointSample& sample) = 0;
  virtual void write(const drivers::JointCommand& command) = 0;
  // Waits for the next tick.
  virtual void wait() = 0;
  // Asks the person for it; returns once it is begun.
  virtual void ask(HandTask task) = 0;
  // True while the task goes on; a person says when it is done.
  virtual bool is_at_work(HandTask task) = 0;
  // The device's own words on what is wrong; empty if nothing is.
  [[nodiscard]] virtual std::string trouble() const = 0;
};

}  // namespace tactus::host
