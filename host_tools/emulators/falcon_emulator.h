// The far side of a Novint Falcon's cable: its FTDI chip, its firmware loader and its firmware, on
// three arms that the caller's plant turns. The same object stands behind a SimulatedUsbEndpoint in
// a test (FalconUsbPeer) and behind a real kernel's gadget (FalconGadget).
//
// Fakes: the chip's requests and its two status bytes in each packet, idle packets at the latency
// timer, both stages of the upload with echo, homing, encoder origin that moves when homed, motors
// that keep their torque when the host falls silent, grip buttons, lights.
// Does not fake: the time of the serial line between chip and processor, the motors' current loop,
// what the real firmware does when commands stop (nobody has published it).
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

struct FalconEmulatorConfig {
  bool firmware_loaded = true;
  std::size_t image_bytes = 1000;  // how long an image its loader waits for
  bool homed = false;              // at power-on
  // An arm finds its reference when it was beyond the first angle and comes back under the second.
  double pulled_out_rad = 1.0;
  double pushed_in_rad = 0.7;
  hal::TimeNs answer_ns = 200'000;       // from a packet to the answer
  double motor_units_per_Nm = 10'000.0;  // what the motors really do
  std::size_t split_after = 0;           // cut answers into two USB packets after so many bytes
  bool leading_zero = false;             // before the loader's answer, as some chips show
};

class FalconEmulator {
 public:
  static constexpr std::size_t kArms = 3;
  static constexpr std::size_t kUsbPacketBytes = 64;

  FalconEmulator(const FalconEmulatorConfig& config, std::uint32_t seed);

  // Takes the host's control request without data. Returns false for a stall.
  bool control(std::uint8_t request_type, std::uint8_t request, std::uint16_t value);
  // Takes bytes that the host sent by bulk-out.
  void receive(hal::TimeNs now_ns, std::span<const std::byte> bytes);
  // Returns when `packet` next has something.
  [[nodiscard]] hal::TimeNs next_packet_ns() const;
  // Returns the next bulk-in packet: status and payload, or the status alone when the latency timer
  // has run out. It is empty if there is nothing yet.
  std::vector<std::byte> packet(hal::TimeNs now_ns);

  // Arm i's angle from the base plane; the plant writes the angle and reads the torque. Top, right,
  // left. The plant's angles count from the next packet on.
  [[nodiscard]] std::array<EmulatedShaft, kArms>& shafts() { return shafts_; }

  void set_buttons(std::uint8_t buttons) { buttons_ = buttons; }
  // Red 8, green 2, blue 4, as in the packet.
  [[nodiscard]] std::uint8_t lights() const { return lights_; }
  [[nodiscard]] bool firmware_loaded() const { return firmware_loaded_; }
  [[nodiscard]] std::uint8_t homed() const { return homed_; }
  [[nodiscard]] std::uint64_t commands() const { return commands_; }
  [[nodiscard]] const std::array<std::int16_t, kArms>& motors() const { return motors_; }
  [[nodiscard]] const std::vector<std::byte>& image() const { return image_; }

  // Erroring: it loses its reference, as after a dip of its supply. Power_cycled: it is without
  // power for kPowerCycle_ns; then its firmware and its reference are gone. The owner of the plug
  // sees to it that `unplugged` looks so to the host too.
  void set_fault(EmulatorFault fault);
  [[nodiscard]] EmulatorFault fault() const { return fault_; }

 private:
  enum class Loader : std::uint8_t { idle, greeted, loading };
  struct Waiting {
    hal::TimeNs due_ns = 0;
    std::byte byte{};
  };

  void take_loader_byte(hal::TimeNs now_ns, std::byte byte);
  void take_firmware_byte(hal::TimeNs now_ns, std::byte byte);
  void obey(hal::TimeNs now_ns);
  void watch_homing();
  void answer(hal::TimeNs now_ns);
  void send(hal::TimeNs due_ns, std::span<const std::byte> bytes);
  void set_baud(std::uint16_t code);
  void cut_power();
  bool has_power(hal::TimeNs now_ns);

  FalconEmulatorConfig config_;
  std::mt19937 random_;
  EmulatorFault fault_ = EmulatorFault::none;
  hal::TimeNs off_until_ns_ = 0;  // in power_cycled; 0: not begun
  std::array<EmulatedShaft, kArms> shafts_{};
  std::array<double, kArms> origin_rad_{};
  std::array<bool, kArms> was_out_{};
  bool origin_known_ = false;
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
  std::vector<std::byte> image_;
  std::vector<std::byte> command_;  // as much of it as has arrived
  std::deque<Waiting> output_;
  hal::TimeNs last_packet_ns_ = 0;
};

}  // namespace tactus::host
