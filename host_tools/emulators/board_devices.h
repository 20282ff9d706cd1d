// Connects emulated boards of several axes (Falcon, Haply, GPIO paddle) to an emulated machine.
// `tactus emulate` uses them in its own process. A board has one fault at a time: a fault of one of
// its axes is a fault of all.
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

// A Falcon on a USB gadget. This and the next two classes connect the board's axes to the machine's
// joints in their order, and must outlive the machine's last step. connect() throws InputError if
// the machine has more joints than the board has axes.
class EmulatedFalcon {
 public:
  // Plugs the gadget in.
  explicit EmulatedFalcon(FalconGadget& gadget);
  // Connects arm i to joint i by the i-th transmission.
  void connect(EmulatedMachine& machine, std::span<const drivers::Transmission> transmissions);

 private:
  void set_fault(EmulatorFault fault);
  // Copies angles to the emulator and torques back: its threads use its own shafts.
  void exchange_shafts();

  FalconGadget& gadget_;
  std::array<EmulatedShaft, FalconEmulator::kArms> shafts_{};
  EmulatorFault fault_ = EmulatorFault::none;
};

// A Haply board on a serial line.
class EmulatedHaply {
 public:
  // `plug`, which may be nullptr, is pulled by the fault `unplugged`.
  explicit EmulatedHaply(HaplyEmulator& board, UsbPlug* plug) : board_(board), plug_(plug) {}
  // Connects port i to joint i by the i-th transmission.
  void connect(EmulatedMachine& machine, std::span<const drivers::Transmission> transmissions);

 private:
  void set_fault(EmulatorFault fault);

  HaplyEmulator& board_;
  UsbPlug* plug_;
};

// A motor with encoder on the pins of a GPIO chip: one joint only.
class EmulatedPaddle {
 public:
  // The axis must outlive this.
  explicit EmulatedPaddle(GpioAxisEmulator& axis) : axis_(axis) {}
  // Connects the axis to joint 0 by the first transmission.
  void connect(EmulatedMachine& machine, std::span<const drivers::Transmission> transmissions);

 private:
  GpioAxisEmulator& axis_;
};

}  // namespace tactus::host
