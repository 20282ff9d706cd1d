// The VESC of a random life: DriveLife of drive_life.h.
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <numbers>

#include "drivers/vesc_can/vesc_can.h"
#include "tests/fuzz/drive_life.h"
#include "tests/fuzz/fuzz_input.h"

namespace tactus::fuzz {

class VescPeer {
 public:
  using Drive = drivers::VescCan;
  static constexpr int kMostTicks = 100;
  static constexpr drivers::VescConfig kConfig{.vesc_id = 1,
                                               .host_id = 2,
                                               .torque_constant_Nm_per_A = 0.05,
                                               .max_torque_Nm = 0.1,
                                               .offers_position = true,
                                               .max_speed_rad_per_s = 100.0,
                                               .jump_margin_rad = 0.05};
  static constexpr double kCount_rad = 2.0 * std::numbers::pi / (6.0 * kConfig.pole_pairs);

  // Positions of one time may lie a margin apart from the first of them, which is not always seen
  // here.
  static constexpr DriveLimits kLimits{
      .max_torque_Nm = kConfig.max_torque_Nm,
      .max_speed_rad_per_s = kConfig.max_speed_rad_per_s,
      .jump_margin_rad = 2.0 * (kConfig.jump_margin_rad + 2.0 * kCount_rad)};

  // Decoded by hand: the current of a set-current frame, in mA, times the torque constant; less by
  // what this product and the limit may differ in their last bit.
  static double torque_of(const hal::CanFrame& frame) {
    if (frame.id != 0x101 || !frame.extended) {
      return 0.0;
    }
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      bits = bits << 8U | std::to_integer<std::uint32_t>(frame.data[i]);
    }
    return (1.0 - 1e-12) * 1e-3 * kConfig.torque_constant_Nm_per_A *
           static_cast<std::int32_t>(bits);
  }

  explicit VescPeer(std::uint8_t /*how*/) {}

  // Some frames make sense, or the axis would never be well for long.
  hal::CanFrame random_frame(FuzzInput& bytes) {
    constexpr std::array<std::uint32_t, 4> kPackets = {0x901, 0x1001, 0x1B01, 0x802};
    switch (bytes.below(8)) {
      case 0:
      case 1:
        return message(0x901, {});
      case 2:
        return no_fault();
      case 3:
      case 4:
        counts_ += bytes.below(3);
        return tachometer();
      default:
        break;
    }
    const std::uint32_t packet = kPackets[bytes.below(kPackets.size())];
    hal::CanFrame frame = bytes.frame(bytes.below(64) == 0 ? bytes.below(0x10000) : packet);
    frame.extended = frame.id > hal::kMaxStandardId || bytes.below(16) != 0;
    return frame;
  }

  // The timeout expires after 20 ms without a current command.
  template <class Send>
  void speak(hal::TimeNs /*now_ns*/, Send send) {
    send(message(0x901, {}));
    send(tachometer());
    send(no_fault());
    send(flags(silent_ms_ > 20 ? 1 : 0));
    ++silent_ms_;
  }

  template <class Send>
  void hear(const hal::CanFrame& frame, hal::TimeNs /*now_ns*/, Send /*send*/) {
    silent_ms_ = frame.id == 0x101 ? 0 : silent_ms_;
  }

 private:
  static hal::CanFrame message(std::uint32_t id, std::initializer_list<std::uint32_t> bytes) {
    hal::CanFrame frame{.id = id, .extended = true, .length = 8};
    std::size_t at = 0;
    for (const std::uint32_t byte : bytes) {
      frame.data[at] = static_cast<std::byte>(byte & 0xFFU);
      ++at;
    }
    return frame;
  }

  static hal::CanFrame flags(std::uint32_t value) {
    return message(0x802, {0x01, 0x01, 0x32, 0x00, 0x20, 0x00, 0x00, value});
  }
  static hal::CanFrame no_fault() {
    return message(0x802, {0x01, 0x01, 0x32, 0x00, 0x00, 0x80, 0x00, 0x00});
  }
  [[nodiscard]] hal::CanFrame tachometer() const {
    return message(0x1B01, {counts_ >> 24U, counts_ >> 16U, counts_ >> 8U, counts_});
  }

  std::uint32_t silent_ms_ = 0;
  std::uint32_t counts_ = 0x7FFF'FFF0;  // close to where it wraps
};

using VescLife = DriveLife<VescPeer>;

}  // namespace tactus::fuzz
