// Emulated boards of several axes as the drives of a machine.
//
// A board has one fault at a time: what is said of one of its axes holds for all.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>

#include "drivers/composition/transmission.h"
#include "host_tools/emulators/emulated_machine.h"
#include "host_tools/emulators/falcon_gadget.h"
#include "host_tools/emulators/gpio_axis_emulator.h"
#include "host_tools/emulators/haply_emulator.h"
#include "host_tools/emulators/usb_plug.h"

namespace tactus::host {

// Each connects the board's axes to the machine's joints, in their order, and must outlive the
// machine's last step. Each throws InputError when the machine has more joints than the board axes.

class EmulatedFalcon {
 public:
  // Plugs it in.
  explicit EmulatedFalcon(FalconGadget& gadget);
  void connect(EmulatedMachine& machine, std::span<const drivers::Transmission> transmissions);

 private:
  void set_fault(EmulatorFault fault);
  void exchange_shafts();

  FalconGadget& gadget_;
  std::array<EmulatedShaft, FalconEmulator::kArms> shafts_{};
  EmulatorFault fault_ = EmulatorFault::none;
};

class EmulatedHaply {
 public:
  // `plug`, if there is one, is pulled by the fault `unplugged`.
  explicit EmulatedHaply(HaplyEmulator& board, UsbPlug* plug) : board_(board), plug_(plug) {}
  void connect(EmulatedMachine& machine, std::span<const drivers::Transmission> transmissions);

 private:
  void set_fault(EmulatorFault fault);

  HaplyEmulator& board_;
  UsbPlug* plug_;
};

// One joint alone.
class EmulatedPaddle {
 public:
  explicit EmulatedPaddle(GpioAxisEmulator& axis) : axis_(axis) {}
  void connect(EmulatedMachine& machine, std::span<const drivers::Transmission> transmissions);

 private:
  GpioAxisEmulator& axis_;
};

}  // namespace tactus::host
