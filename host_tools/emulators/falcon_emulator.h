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
#include <deque>
#include <random>
#include <span>
#include <vector>

#include "hal/clock.h"
#include "host_tools/emulators/can_emulator.h"
#include "host_tools/emulators/shaft.h"

namespace tactus::host {

// How the device starts and answers.
struct FalconEmulatorConfig {
  bool firmware_loaded = true;
  // The length of the firmware image for which the loader waits.
  std::size_t image_bytes = 1000;
  // True if all arms know their reference at power-up.
  bool homed = false;
  // An arm finds its reference when it has been beyond the first angle and comes back below the
  // second.
  double pulled_out_rad = 1.0;
  double pushed_in_rad = 0.7;
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
  static constexpr std::size_t kArms = 3;
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
  [[nodiscard]] std::uint8_t lights() const { return lights_; }
  [[nodiscard]] bool firmware_loaded() const { return firmware_loaded_; }
  // Returns one bit for each arm that knows its reference.
  [[nodiscard]] std::uint8_t homed() const { return homed_; }
  // Returns how many commands the firmware has obeyed.
  [[nodiscard]] std::uint64_t commands() const { return commands_; }
  // Returns the last command of each motor, in the firmware's unit.
  [[nodiscard]] const std::array<std::int16_t, kArms>& motors() const { return motors_; }
  // Returns the firmware image that was uploaded.
  [[nodiscard]] const std::vector<std::byte>& image() const { return image_; }

  // Sets a fault. `erroring`: the device loses its reference, as after a dip of its supply.
  // `power_cycled`: it has no power for kPowerCycle_ns and then neither firmware nor reference. For
  // `unplugged`, the owner of the plug must also remove the device from the bus.
  void set_fault(EmulatorFault fault);
  [[nodiscard]] EmulatorFault fault() const { return fault_; }

 private:
  // How far an upload is.
  enum class Loader : std::uint8_t { idle, greeted, loading };
  // A byte for the host and when it may be sent.
  struct Waiting {
    hal::TimeNs due_ns = 0;
    std::byte byte{};
  };

  // Takes a byte while the baud rate selects the loader.
  void take_loader_byte(hal::TimeNs now_ns, std::byte byte);
  // Takes a byte of a command for the firmware.
  void take_firmware_byte(hal::TimeNs now_ns, std::byte byte);
  // Sets motors, lights and homing from the complete command and answers it.
  void obey(hal::TimeNs now_ns);
  // Marks an arm as homed once it has been pulled out and then pushed in while homing is commanded.
  void watch_homing();
  // Queues the answer: the arms' counts, the buttons and which arms are homed.
  void answer(hal::TimeNs now_ns);
  // Queues bytes for the host, later under the fault `delayed`; drops them under `silent`.
  void send(hal::TimeNs due_ns, std::span<const std::byte> bytes);
  // Takes the divisor of the baud rate, which selects firmware or loader.
  void set_baud(std::uint16_t code);
  // Loses firmware, reference and torque.
  void cut_power();
  // Returns false while unplugged or in a power cycle. The cycle's time starts at the first call.
  bool has_power(hal::TimeNs now_ns);

  FalconEmulatorConfig config_;
  std::mt19937 random_;
  EmulatorFault fault_ = EmulatorFault::none;
  // The end of a power cycle; 0 if it has not begun.
  hal::TimeNs off_until_ns_ = 0;
  std::array<EmulatedShaft, kArms> shafts_{};
  // The arms' angles at the first command, rad.
  std::array<double, kArms> origin_rad_{};
  // True once the arm has been pulled out, which is the first half of homing.
  std::array<bool, kArms> was_out_{};
  bool origin_known_ = false;
  // The commanded values in the motors' own units; `homed_` has a bit for each arm.
  std::array<std::int16_t, kArms> motors_{};
  std::uint8_t buttons_ = 0;
  std::uint8_t lights_ = 0;
  std::uint8_t homed_ = 0;
  bool homing_ = false;
  std::uint64_t commands_ = 0;

  std::uint16_t baud_ = 0;
  std::uint8_t latency_ms_ = 16;
  bool firmware_loaded_;
  Loader loader_ = Loader::idle;
  // The bytes of the firmware that have been uploaded.
  std::vector<std::byte> image_;
  // The part of a command that has arrived.
  std::vector<std::byte> command_;
  std::deque<Waiting> output_;
  hal::TimeNs last_packet_ns_ = 0;
};

}  // namespace tactus::host
