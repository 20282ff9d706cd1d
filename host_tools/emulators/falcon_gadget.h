// The emulated Falcon behind a real kernel's USB: function_fs.h tells how to set the gadget up.
#pragma once

#include <mutex>
#include <utility>

#include "host_tools/emulators/falcon_emulator.h"
#include "host_tools/emulators/function_fs.h"

namespace tactus::host {

class FalconGadget final : private GadgetDevice {
 public:
  // Unplugged at first. Throws InputError, text for a user.
  FalconGadget(const FalconEmulatorConfig& config, std::uint32_t seed, const GadgetPlace& place);

  // Plugging in and out as a hand does; unplugged, the device has no power.
  void plug_in();
  void unplug();

  // Calls action(FalconEmulator&) while nobody else uses it: for the plant's angles and torques,
  // for faults. `unplugged` among them is better said by unplug().
  template <class Action>
  auto with_emulator(Action&& action) {
    const std::lock_guard lock(gadget_.mutex());
    gadget_.wake();
    return std::forward<Action>(action)(emulator_);
  }

  // The same for the shafts alone, which a plant turns many times between two packets.
  template <class Action>
  auto with_shafts(Action&& action) {
    const std::lock_guard lock(gadget_.mutex());
    return std::forward<Action>(action)(emulator_.shafts());
  }

 private:
  bool control_out(const hal::UsbSetup& setup) override;
  std::optional<std::vector<std::byte>> control_in(const hal::UsbSetup& setup) override;
  void bulk_out(hal::TimeNs now_ns, std::span<const std::byte> bytes) override;
  hal::TimeNs next_packet_ns() override;
  std::vector<std::byte> packet(hal::TimeNs now_ns) override;

  FalconEmulator emulator_;
  FunctionFs gadget_;  // last: its threads use the rest
};

}  // namespace tactus::host
