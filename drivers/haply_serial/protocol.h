// The byte protocol of the Haply boards of the first generation (hAPI: Haply board M0, M3 and
// development kit). It encodes and decodes messages, without input or output.
//
//   host  00 id                                   reset: forget the setup
//   host  01 id setup                             the ports with motors and encoders; no answer
//   host  02 id torques (f32, N m)                answered by
//   board id angles (f32, degrees)
//
// Numbers are little-endian. There is no frame, no checksum, no acknowledgement and no watchdog:
// the board keeps the last torque. The board misreads a command that reaches it in pieces, so each
// goes out in one write. A command of zeros is safe even for a board that was never set up, which
// reads the rest of it as resets.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace tactus::drivers {

inline constexpr std::size_t kHaplyMaxAxes = 4;
// The torque to which the board itself clamps.
inline constexpr double kHaplyTorqueLimit_Nm = 0.123;

// The setup of one port.
struct HaplyAxisSetup {
  bool motor_counter_clockwise = false;
  bool encoder_counter_clockwise = false;
  double counts_per_turn = 13'824.0;
  double angle_now_rad = 0.0;  // the angle that the encoder shall report where it stands
};

// One command. It fits into one USB packet.
class HaplyMessage {
 public:
  void add(std::uint8_t value);
  void add(float value);
  [[nodiscard]] std::span<const std::byte> bytes() const { return {bytes_.data(), size_}; }

 private:
  std::array<std::byte, 64> bytes_{};
  std::size_t size_ = 0;
};

HaplyMessage haply_reset(std::uint8_t device_id);
// Returns the setup of ports 1, 2... in this order, each with a motor and an encoder; at most
// kHaplyMaxAxes. The board can tell ports apart only if none is left out.
HaplyMessage haply_setup(std::uint8_t device_id, std::span<const HaplyAxisSetup> axes);
// Returns a command of at most kHaplyMaxAxes torques, clamped to +-kHaplyTorqueLimit_Nm. A torque
// that is not finite counts as zero.
HaplyMessage haply_torques(std::uint8_t device_id, std::span<const double> torque_Nm);

constexpr std::size_t haply_reply_bytes(std::size_t axes) {
  return 1 + 4 * axes;
}

using HaplyAngles = std::array<double, kHaplyMaxAxes>;  // rad

// Decodes a reply of haply_reply_bytes(axes) bytes. Returns nothing if it is another device's, or
// if an angle is not finite or beyond a hundred turns.
std::optional<HaplyAngles> decode_haply_reply(std::span<const std::byte> reply,
                                              std::uint8_t device_id, std::size_t axes);

}  // namespace tactus::drivers
