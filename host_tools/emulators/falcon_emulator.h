// A Novint Falcon as its USB cable shows it: the FTDI chip, the firmware loader and the firmware,
// on three arms that the caller's plant turns. The same object stands behind a SimulatedUsbEndpoint
// in a test (falcon_usb_peer.h) and behind a real kernel's gadget (falcon_gadget.h).
//
// It fakes the chip's requests and the two status bytes of each packet, idle packets at the latency
// timer, both stages of the upload with their echo, homing, an encoder origin that moves when
// homed, motors that keep their torque when the host falls silent, grip buttons, and lights. It
// does not fake the time on the serial line between chip and processor, the motors' current loop,
// and the reaction of the real firmware when commands stop, which nobody has published.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include "hal/clock.h"
#include "host_tools/emulators/emulator_fault.h"
#include "host_tools/emulators/falcon_homing.h"
#include "host_tools/emulators/ftdi_chip.h"
#include "host_tools/emulators/shaft.h"

namespace tactus::host {

// How the device starts and answers.
struct FalconEmulatorConfig {
  bool firmware_loaded = true;
  // The length of the firmware image for which the loader waits.
  std::size_t image_bytes = 1000;
  // True if all arms know their reference at power-up.
  bool homed = false;
  // The time from a command to its answer.
  hal::TimeNs answer_ns = 200'000;
  // The scale of the real motors, which the driver's configuration must match.
  double motor_units_per_Nm = 10'000.0;
  // Cuts answers into USB packets of this many bytes; 0: no cuts.
  std::size_t split_after = 0;
  // True for chips that put a zero byte before the loader's answer.
  bool leading_zero = false;
};

// One device. Its owner serialises the calls.
class FalconEmulator {
 public:
  static constexpr std::size_t kArms = FalconHoming::kArms;
  static constexpr std::size_t kUsbPacketBytes = 64;

  FalconEmulator(const FalconEmulatorConfig& config, std::uint32_t seed);

  // Handles a control request without data. Returns false to stall it.
  bool control(std::uint8_t request_type, std::uint8_t request, std::uint16_t value);
  // Handles bytes that the host sent to the bulk-out endpoint.
  void receive(hal::TimeNs now_ns, std::span<const std::byte> bytes);
  // Returns when packet() will have something to send.
  [[nodiscard]] hal::TimeNs next_packet_ns() const;
  // Returns the next bulk-in packet: status bytes and payload, or the status bytes alone when the
  // latency timer has run out. It is empty if nothing is due yet.
  std::vector<std::byte> packet(hal::TimeNs now_ns);

  // The three arms, top, right and left, as angles from the base plane. The plant writes angles and
  // reads torques; new angles count from the next command on.
  [[nodiscard]] std::array<EmulatedShaft, kArms>& shafts() { return shafts_; }

  void set_buttons(std::uint8_t buttons) { buttons_ = buttons; }
  // Returns the lights as the command sets them: red 8, green 2, blue 4.
  [[nodiscard]] std::uint8_t lights() const { return obeyed_.lights; }
  [[nodiscard]] bool firmware_loaded() const { return firmware_.is_loaded; }
  // Returns one bit for each arm that knows its reference.
  [[nodiscard]] std::uint8_t homed() const { return homing_.homed(); }
  // Returns how many commands the firmware has obeyed.
  [[nodiscard]] std::uint64_t commands() const { return obeyed_.commands; }
  // Returns the last command of each motor, in the firmware's unit.
  [[nodiscard]] const std::array<std::int16_t, kArms>& motors() const { return obeyed_.motors; }
  // Returns the firmware image that was uploaded.
  [[nodiscard]] const std::vector<std::byte>& image() const { return firmware_.image; }

  // Sets a fault. `erroring`: the device loses its reference, as after a dip of its supply.
  // `power_cycled`: it has no power for kPowerCycle_ns and then neither firmware nor reference. For
  // `unplugged`, the owner of the plug must also remove the device from the bus.
  void set_fault(EmulatorFault fault);
  [[nodiscard]] EmulatorFault fault() const { return fault_.kind(); }

 private:
  // How far an upload is.
  enum class Loader : std::uint8_t { idle, greeted, loading };
  // The firmware and its upload.
  struct Firmware {
    bool is_loaded = false;
    Loader loader = Loader::idle;
    // The bytes that have been uploaded.
    std::vector<std::byte> image;
  };
  // The commands that the firmware has obeyed: the last values in the motors' own units, the last
  // lights, and the number of commands.
  struct Obeyed {
    std::array<std::int16_t, kArms> motors{};
    std::uint8_t lights = 0;
    std::uint64_t commands = 0;
  };

  // Takes a byte while the baud rate selects the loader.
  void take_loader_byte(hal::TimeNs now_ns, std::byte byte);
  // Takes a byte of a command for the firmware.
  void take_firmware_byte(hal::TimeNs now_ns, std::byte byte);
  // Sets motors, lights and homing from the complete command and answers it.
  void obey(hal::TimeNs now_ns);
  // Queues the answer: the arms' counts, the buttons and which arms are homed.
  void answer(hal::TimeNs now_ns);
  // Queues bytes for the host, later under the fault `delayed`; drops them under `silent`.
  void send(hal::TimeNs due_ns, std::span<const std::byte> bytes);
  // Takes the divisor of the baud rate, which selects firmware or loader.
  void set_baud(std::uint16_t code);
  // Loses firmware, reference and torque.
  void cut_power();

  FalconEmulatorConfig config_;
  std::mt19937 random_;
  ActiveFault fault_;
  FtdiChip chip_;
  std::array<EmulatedShaft, kArms> shafts_{};
  FalconHoming homing_;
  Obeyed obeyed_;
  std::uint8_t buttons_ = 0;
  Firmware firmware_;
  // The part of a command that has arrived.
  std::vector<std::byte> command_;
};

}  // namespace tactus::host
