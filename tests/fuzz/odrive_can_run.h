// The ODrive axis of a random life: DriveLife of drive_life.h.
#pragma once

#include <cstdint>
#include <cstring>

#include "drivers/odrive_can/odrive_can.h"
#include "tests/fuzz/drive_life.h"
#include "tests/fuzz/fuzz_input.h"

namespace tactus::fuzz {

class ODrivePeer {
 public:
  using Drive = drivers::ODriveCan;
  static constexpr int kMostTicks = 800;
  static constexpr drivers::ODriveConfig kConfig{
      .node_id = 1, .max_torque_Nm = 0.1, .max_speed_rad_per_s = 100.0, .jump_margin_rad = 0.05};

  static constexpr DriveLimits kLimits{.max_torque_Nm = kConfig.max_torque_Nm,
                                       .max_speed_rad_per_s = kConfig.max_speed_rad_per_s,
                                       .jump_margin_rad = kConfig.jump_margin_rad};

  // Decoded by hand: the torque of a Set_Input_Torque frame.
  static double torque_of(const hal::CanFrame& frame) {
    constexpr std::uint32_t kSetInputTorque = 0x0E;
    if (frame.id != (kFirstId | kSetInputTorque)) {
      return 0.0;
    }
    float torque_Nm = 0.0F;
    std::memcpy(&torque_Nm, frame.data.data(), sizeof torque_Nm);
    return static_cast<double>(torque_Nm);
  }

  // Bit 1 of `how` makes it firmware 0.6, else 0.5.
  explicit ODrivePeer(std::uint8_t how) : is_0_6_((how & 2U) != 0) {}

  // Some frames make sense, or the axis would never be well for long.
  hal::CanFrame random_frame(FuzzInput& bytes) {
    switch (bytes.below(8)) {
      case 0:
        return heartbeat(8);
      case 1:
      case 2:
      case 3:
        turns_ += 1e-6F * static_cast<float>(bytes.take<std::int16_t>());
        return estimates(turns_, 1e-3F * static_cast<float>(bytes.take<std::int16_t>()));
      case 4:
        return bytes.frame(bytes.below(0x800));
      default:
        return bytes.frame(kFirstId | bytes.below(32));
    }
  }

  // The watchdog trips after 20 ms of silence.
  template <class Send>
  void speak(hal::TimeNs /*now_ns*/, Send send) {
    if (silent_ms_ > 20) {
      is_closed_ = false;
      error_ = is_0_6_ ? 0x0100'0000 : 0x800;
    }
    ++silent_ms_;
    send(heartbeat(is_closed_ ? 8 : 1, error_));
    send(estimates(turns_, 0.0F));
  }

  template <class Send>
  void hear(const hal::CanFrame& frame, hal::TimeNs /*now_ns*/, Send send) {
    silent_ms_ = 0;
    if (frame.id == kFirstId && is_0_6_) {
      hal::CanFrame version{.id = kFirstId, .length = 8};
      version.data[0] = std::byte{2};
      send(version);
    } else if (frame.id == (kFirstId | 0x07U)) {
      is_closed_ = frame.data[0] == std::byte{8};
    } else if (frame.id == (kFirstId | 0x18U)) {
      error_ = 0;
    }
  }

 private:
  static constexpr std::uint32_t kFirstId = 1U << 5U;  // node 1

  static hal::CanFrame heartbeat(std::uint8_t state, std::uint32_t error = 0) {
    hal::CanFrame frame{.id = kFirstId | 0x01U, .length = 8};
    std::memcpy(frame.data.data(), &error, sizeof error);
    frame.data[4] = std::byte{state};
    return frame;
  }

  static hal::CanFrame estimates(float turns, float turns_per_s) {
    hal::CanFrame frame{.id = kFirstId | 0x09U, .length = 8};
    std::memcpy(frame.data.data(), &turns, sizeof turns);
    std::memcpy(&frame.data[4], &turns_per_s, sizeof turns_per_s);
    return frame;
  }

  bool is_0_6_;
  bool is_closed_ = false;
  int silent_ms_ = 0;
  std::uint32_t error_ = 0;
  float turns_ = 0.25F;
};

using ODriveLife = DriveLife<ODrivePeer>;

}  // namespace tactus::fuzz
