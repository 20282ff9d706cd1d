// The emulated Falcon behind a real kernel's USB; function_fs.h tells how to set the gadget up.
// `tactus emulate falcon` uses it.
#pragma once

#include <mutex>
#include <utility>

#include "host_tools/emulators/falcon_emulator.h"
#include "host_tools/emulators/function_fs.h"

namespace tactus::host {

// The device with the threads that serve its endpoints.
class FalconGadget final : private GadgetDevice {
 public:
  // Starts unplugged. Throws InputError if the kernel does not accept the gadget.
  FalconGadget(const FalconEmulatorConfig& config, std::uint32_t seed, const GadgetPlace& place);

  // Plug the device in and out as a hand does. Unplugged, it has no power.
  void plug_in();
  void unplug();

  // Calls action(FalconEmulator&) while no thread uses the emulator: for faults and settings. Use
  // unplug() instead of the fault `unplugged`.
  template <class Action>
  auto with_emulator(Action&& action) {
    const std::lock_guard lock(gadget_.mutex());
    gadget_.wake();
    return std::forward<Action>(action)(emulator_);
  }

  // Calls action() with the shafts alone, which a plant turns many times between two packets; it
  // does not wake the thread that sends.
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
  // The last member, since its threads use the others.
  FunctionFs gadget_;
};

}  // namespace tactus::host
