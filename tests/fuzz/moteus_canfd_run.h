// The moteus servo of a random life: DriveLife of drive_life.h.
#pragma once

#include <cstdint>
#include <cstring>

#include "drivers/moteus_canfd/moteus_canfd.h"
#include "tests/fuzz/drive_life.h"
#include "tests/fuzz/fuzz_input.h"

namespace tactus::fuzz {

class MoteusPeer {
 public:
  using Drive = drivers::MoteusCanFd;
  static constexpr int kMostTicks = 500;
  static constexpr drivers::MoteusConfig kConfig{
      .max_torque_Nm = 0.1, .max_speed_rad_per_s = 100.0, .jump_margin_rad = 0.05};

  static constexpr DriveLimits kLimits{.max_torque_Nm = kConfig.max_torque_Nm,
                                       .max_speed_rad_per_s = kConfig.max_speed_rad_per_s,
                                       .jump_margin_rad = kConfig.jump_margin_rad};

  // Decoded by hand: the torque of a frame that writes mode 10 and then three floats from 0x20 on.
  static double torque_of(const hal::CanFrame& frame) {
    constexpr std::size_t kTorqueAt = 13;
    if (frame.length < kTorqueAt + 4 || frame.data[2] != std::byte{10}) {
      return 0.0;
    }
    require(frame.data[3] == std::byte{0x0F} && frame.data[4] == std::byte{0x20},
            "the torque stands where it is looked for");
    float torque_Nm = 0.0F;
    std::memcpy(&torque_Nm, &frame.data[kTorqueAt], sizeof torque_Nm);
    return static_cast<double>(torque_Nm);
  }

  explicit MoteusPeer(std::uint8_t /*how*/) {}

  // Some frames make sense, or the servo would never be well for long.
  hal::CanFrame random_frame(FuzzInput& bytes) {
    hal::CanFrame frame;
    switch (bytes.below(8)) {
      case 0:
      case 1:
      case 2:
        turns_ += 1e-6F * static_cast<float>(bytes.take<std::int16_t>());
        return reply(10, turns_, 1e-3F * static_cast<float>(bytes.take<std::int16_t>()));
      case 3:
        return reply(bytes.take<std::uint8_t>() % 16, turns_, 0.0F);
      case 4:
        frame = reply(10, turns_, 0.0F);
        frame.data[bytes.below(24)] = bytes.take<std::byte>();
        return frame;
      case 5:
        return bytes.frame(bytes.take<std::uint32_t>() & hal::kMaxExtendedId);
      default:
        return bytes.frame(kReplyId);
    }
  }

  // The watchdog trips after 20 ms without a torque.
  template <class Send>
  void speak(hal::TimeNs /*now_ns*/, Send send) {
    mode_ = mode_ == 10 && silent_ms_ > 20 ? std::uint8_t{11} : mode_;
    ++silent_ms_;
    send(reply(mode_, turns_, 0.0F));
  }

  template <class Send>
  void hear(const hal::CanFrame& frame, hal::TimeNs /*now_ns*/, Send /*send*/) {
    if (frame.data[0] == std::byte{0x01}) {  // it writes the mode
      mode_ = std::to_integer<std::uint8_t>(frame.data[2]);
      silent_ms_ = 0;
    }
  }

 private:
  static constexpr std::uint32_t kReplyId = 0x100;

  static hal::CanFrame reply(std::uint8_t mode, float turns, float turns_per_s) {
    hal::CanFrame frame{.id = kReplyId, .fd = true, .bit_rate_switch = true, .length = 24};
    frame.data.fill(std::byte{0x50});
    frame.data[0] = std::byte{0x21};
    frame.data[1] = std::byte{0x00};
    frame.data[2] = std::byte{mode};
    frame.data[3] = std::byte{0x2E};
    frame.data[4] = std::byte{0x01};
    std::memcpy(&frame.data[5], &turns, sizeof turns);
    std::memcpy(&frame.data[9], &turns_per_s, sizeof turns_per_s);
    return frame;
  }

  std::uint8_t mode_ = 0;
  int silent_ms_ = 0;
  float turns_ = 0.25F;
};

using MoteusLife = DriveLife<MoteusPeer>;

}  // namespace tactus::fuzz
