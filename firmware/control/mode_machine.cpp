#include "firmware/control/mode_machine.h"

#include "firmware/safety/faults.h"

namespace tactus::firmware {

void ModeMachine::configure(std::uint64_t guards_off) {
  *this = ModeMachine{};
  guards_off_ = guards_off;
}

void ModeMachine::begin_tick() {
  raised_ = guards_off_ != kNoFault ? kLimitGuardsOff : kNoFault;
  has_entered_fault_ = false;
}

void ModeMachine::raise(std::uint64_t bits) {
  bits &= ~guards_off_;
  raised_ |= bits;
  if ((bits & kFaultMask) != 0) {
    faults_ |= bits & kFaultMask;
    step(Event::fault);
  }
}

void ModeMachine::raise(const EffortFinding& found) {
  const std::uint64_t faults = found.faults & ~guards_off_;
  if (faults != kNoFault && fault_joint_ == 0) {
    fault_joint_ = found.joint;
  }
  raise(faults);
}

void ModeMachine::raise_for(std::uint32_t device) {
  if ((guards_off_ & kFaultOtherDevice) == 0 && fault_device_ == 0) {
    fault_device_ = device;
  }
  raise(kFaultOtherDevice);
}

EnteredModes ModeMachine::advance(bool is_referenced, Request request) {
  if (mode_ == Mode::active && !is_referenced) {
    raise(kFaultReferenceLost);
  }
  const Mode before = mode_;
  step(is_referenced ? Event::device_ready : Event::device_not_ready);
  const Mode between = mode_;
  take(request);
  // Only the device's event leads from `homing` to `ready`, and only a request to `active`.
  return {.ready_from_homing = before == Mode::homing && between == Mode::ready,
          .active = between != Mode::active && mode_ == Mode::active};
}

void ModeMachine::take(Request request) {
  switch (request) {
    case Request::none:
      break;
    case Request::home:
      step(Event::home);
      break;
    case Request::enable:
      step(Event::enable);
      break;
    case Request::disable:
      step(Event::disable);
      break;
    // A reset in a tick with trouble would only raise the fault again.
    case Request::reset:
      if (!has_raised(kFaultMask)) {
        step(Event::reset);
      }
      break;
    case Request::estop:
      raise(kFaultOperatorStop);
      break;
  }
}

void ModeMachine::step(Event event) {
  const Mode from = mode_;
  mode_ = next_mode(from, event);
  if (mode_ == from) {
    return;
  }
  if (mode_ == Mode::init) {
    faults_ = kNoFault;
    fault_joint_ = 0;
    fault_device_ = 0;
  }
  has_entered_fault_ = has_entered_fault_ || mode_ == Mode::fault;
}

void ModeMachine::transfer(rendering::StateArchive& archive) {
  [[maybe_unused]] auto& [guards_off, mode, faults, fault_joint, fault_device, raised,
                          has_entered_fault] = *this;
  archive.choice(mode, Mode::fault);
  archive(faults, fault_joint, fault_device);
}

}  // namespace tactus::firmware
