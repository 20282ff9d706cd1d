// One random life of a VESC.
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <numbers>

#include "drivers/vesc_can/vesc_can.h"
#include "tests/fuzz/drive_properties.h"
#include "tests/fuzz/fuzz_input.h"

namespace tactus::fuzz {

class VescLife {
 public:
  // Ends the program if a property breaks.
  void run(FuzzInput input) {
    drive_.start(now_ns_);
    if ((input.take<std::uint8_t>() & 1U) != 0) {
      bring_up();
    }
    fuzz_drive(drive_, properties_, now_ns_, input, torque_of,
               [this](FuzzInput& bytes) { return random_frame(bytes); });
  }

  // Whether the bring-up works: else nothing worth the while is tested.
  [[nodiscard]] bool comes_up() {
    drive_.start(now_ns_);
    bring_up();
    return drive_.sample().status == drivers::kDeviceOk;
  }

 private:
  static constexpr drivers::VescConfig kAxis{.vesc_id = 1,
                                             .host_id = 2,
                                             .torque_constant_Nm_per_A = 0.05,
                                             .max_torque_Nm = 0.1,
                                             .offers_position = true,
                                             .max_speed_rad_per_s = 100.0,
                                             .jump_margin_rad = 0.05};
  static constexpr double kCount_rad = 2.0 * std::numbers::pi / (6.0 * kAxis.pole_pairs);

  // Positions of one time may lie a margin apart from the first of them, which one knows only who
  // sees them all.
  static constexpr DriveLimits kLimits{
      .max_torque_Nm = kAxis.max_torque_Nm,
      .max_speed_rad_per_s = kAxis.max_speed_rad_per_s,
      .jump_margin_rad = 2.0 * (kAxis.jump_margin_rad + 2.0 * kCount_rad)};

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
    return (1.0 - 1e-12) * 1e-3 * kAxis.torque_constant_Nm_per_A * static_cast<std::int32_t>(bits);
  }

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

  // As a VESC does that is well; its timeout expires after 20 ms without a current command.
  void bring_up() {
    std::uint32_t silent_ms = 0;
    for (int tick = 0; tick < 100 && drive_.sample().status != drivers::kDeviceOk; ++tick) {
      now_ns_ += 1'000'000;
      for (const hal::CanFrame& frame :
           {message(0x901, {}), tachometer(), no_fault(), flags(silent_ms > 20 ? 1 : 0)}) {
        drive_.take({.time_ns = now_ns_, .frame = frame});
      }
      drivers::CanOutbox outbox;
      drive_.command(now_ns_, {.torque_Nm = 1.0, .enable = true}, outbox);
      properties_.check_outbox(drive_.sample(), outbox, torque_of);
      const bool is_commanded = !outbox.frames().empty() && outbox.frames()[0].id == 0x101;
      silent_ms = is_commanded ? 0 : silent_ms + 1;
    }
  }

  drivers::VescCan drive_{kAxis};
  DriveProperties properties_{kLimits};
  hal::TimeNs now_ns_ = 1'000'000'000;
  std::uint32_t counts_ = 0x7FFF'FFF0;  // close to where it wraps
};

}  // namespace tactus::fuzz
