#include "host_tools/emulators/board_devices.h"

#include <fmt/format.h>

#include <string_view>

#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

void check_joints(const EmulatedMachine& machine, std::size_t axes, std::string_view board) {
  if (machine.joints() > axes) {
    throw InputError(fmt::format("{} turns {} joint{}, but the mechanism has {}", board, axes,
                                 axes == 1 ? "" : "s", machine.joints()));
  }
}

}  // namespace

EmulatedFalcon::EmulatedFalcon(FalconGadget& gadget) : gadget_(gadget) {
  gadget_.plug_in();
}

void EmulatedFalcon::connect(EmulatedMachine& machine,
                             std::span<const drivers::Transmission> transmissions) {
  check_joints(machine, shafts_.size(), "a Falcon");
  for (std::size_t i = 0; i < machine.joints(); ++i) {
    machine.connect({.shaft = &shafts_[i],
                     .transmission = transmissions[i],
                     .set_fault = [this](EmulatorFault fault) { set_fault(fault); }});
  }
  machine.add_device([this](hal::TimeNs) { exchange_shafts(); });
}

void EmulatedFalcon::set_fault(EmulatorFault fault) {
  if (fault == fault_) {
    return;
  }
  if (fault == EmulatorFault::unplugged) {
    gadget_.unplug();
  } else if (fault_ == EmulatorFault::unplugged) {
    gadget_.plug_in();
  }
  fault_ = fault;
  if (fault != EmulatorFault::unplugged) {
    gadget_.with_emulator([fault](FalconEmulator& falcon) { falcon.set_fault(fault); });
  }
}

void EmulatedFalcon::exchange_shafts() {
  gadget_.with_shafts([this](std::array<EmulatedShaft, FalconEmulator::kArms>& theirs) {
    for (std::size_t i = 0; i < shafts_.size(); ++i) {
      theirs[i].position_rad = shafts_[i].position_rad;
      theirs[i].velocity_rad_per_s = shafts_[i].velocity_rad_per_s;
      shafts_[i].torque_Nm = theirs[i].torque_Nm;
    }
  });
}

void EmulatedHaply::connect(EmulatedMachine& machine,
                            std::span<const drivers::Transmission> transmissions) {
  check_joints(machine, HaplyEmulator::kPorts, "a Haply board");
  for (std::size_t i = 0; i < machine.joints(); ++i) {
    machine.connect({.shaft = &board_.shafts()[i],
                     .transmission = transmissions[i],
                     .set_fault = [this](EmulatorFault fault) { set_fault(fault); }});
  }
  machine.add_device([this](hal::TimeNs now_ns) { board_.run(now_ns); });
}

void EmulatedHaply::set_fault(EmulatorFault fault) {
  if (fault == board_.fault()) {
    return;
  }
  board_.set_fault(fault);
  if (plug_ != nullptr) {
    plug_->set_plugged_in(fault != EmulatorFault::unplugged);
  }
}

void EmulatedPaddle::connect(EmulatedMachine& machine,
                             std::span<const drivers::Transmission> transmissions) {
  check_joints(machine, 1, "a paddle's board");
  machine.connect({.shaft = &axis_.shaft(),
                   .transmission = transmissions[0],
                   .set_fault = [this](EmulatorFault fault) { axis_.set_fault(fault); }});
  machine.add_device([this](hal::TimeNs now_ns) { axis_.run(now_ns); });
}

}  // namespace tactus::host
