// The mode with its faults and limits: the one place that raises them. One thread; real time.
#pragma once

#include <cstdint>

#include "firmware/control/mode.h"
#include "firmware/safety/effort_guard.h"
#include "rendering/state_archive.h"

namespace tactus::firmware {

// The modes that an advance has entered. Both may be set: a device that becomes ready may be
// enabled in the same tick.
struct EnteredModes {
  // `ready` from `homing`: the joints' zero has moved.
  bool ready_from_homing = false;
  bool active = false;
};

// The mode, the latched faults, and the FaultBits of the present tick.
class ModeMachine {
 public:
  // Starts anew in `init`. The faults and limits of `guards_off` are never raised.
  void configure(std::uint64_t guards_off);

  // Forgets the faults and limits of the last tick.
  void begin_tick();

  // Raises faults and limits. A fault changes the mode at once, in any stage of a tick: the later
  // stages see `fault` and give zero.
  void raise(std::uint64_t bits);
  // Raises the faults of a finding and latches its joint. The first joint stays until a reset.
  void raise(const EffortFinding& found);
  // Raises kFaultOtherDevice for the fault of another device, 1 for the controller's first, and
  // latches that number. The first one stays until a reset.
  void raise_for(std::uint32_t device);

  // Applies the device's event and then the request. A reset acts only if no fault was raised in
  // this tick. Returns the modes whose entry needs work. Call once per tick, after the guards of
  // the inputs.
  EnteredModes advance(bool is_referenced, Request request);

  // Returns the present mode.
  [[nodiscard]] Mode mode() const { return mode_; }
  // Returns the latched FaultBits.
  [[nodiscard]] std::uint64_t faults() const { return faults_; }
  // Returns the joint of a latched fault of a motor, 1 for the first; 0: none.
  [[nodiscard]] std::uint32_t fault_joint() const { return fault_joint_; }
  // Returns the device of a latched kFaultOtherDevice, 1 for the first; 0: none.
  [[nodiscard]] std::uint32_t fault_device() const { return fault_device_; }
  // Returns the faults and limits of this tick.
  [[nodiscard]] std::uint64_t raised() const { return raised_; }
  // Returns true if any of the bits was raised in this tick.
  [[nodiscard]] bool has_raised(std::uint64_t bits) const { return (raised_ & bits) != 0; }
  // Returns true if the mode became `fault` in this tick.
  [[nodiscard]] bool has_entered_fault() const { return has_entered_fault_; }

  // Writes its memory to the archive, or reads it back.
  void transfer(rendering::StateArchive& archive);

 private:
  void step(Event event);
  void take(Request request);

  std::uint64_t guards_off_ = 0;
  Mode mode_ = Mode::init;
  std::uint64_t faults_ = 0;
  std::uint32_t fault_joint_ = 0;
  std::uint32_t fault_device_ = 0;
  std::uint64_t raised_ = 0;
  bool has_entered_fault_ = false;
};

}  // namespace tactus::firmware
