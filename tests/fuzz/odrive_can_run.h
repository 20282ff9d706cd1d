// One random life of an ODrive axis.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>

#include "drivers/odrive_can/odrive_can.h"
#include "tests/fuzz/drive_properties.h"
#include "tests/fuzz/fuzz_input.h"

namespace tactus::fuzz {

class ODriveLife {
 public:
  // Ends the program if a property breaks.
  void run(FuzzInput input) {
    drive_.start(now_ns_);
    const auto how = input.take<std::uint8_t>();
    if ((how & 1U) != 0) {
      bring_up((how & 2U) != 0);
    }
    fuzz_drive(drive_, properties_, now_ns_, input, torque_of,
               [this](FuzzInput& bytes) { return random_frame(bytes); });
  }

  // Whether the bring-up of `how` bit 0 works: else nothing worth the while is tested.
  [[nodiscard]] bool comes_up(bool is_0_6) {
    drive_.start(now_ns_);
    bring_up(is_0_6);
    return drive_.sample().status == drivers::kDeviceOk;
  }

 private:
  static constexpr std::uint32_t kFirstId = 1U << 5U;  // node 1
  static constexpr drivers::ODriveConfig kAxis{
      .node_id = 1, .max_torque_Nm = 0.1, .max_speed_rad_per_s = 100.0, .jump_margin_rad = 0.05};

  static constexpr DriveLimits kLimits{.max_torque_Nm = kAxis.max_torque_Nm,
                                       .max_speed_rad_per_s = kAxis.max_speed_rad_per_s,
                                       .jump_margin_rad = kAxis.jump_margin_rad};

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

  // As a drive does that is well; its watchdog trips after 20 ms of silence.
  void bring_up(bool is_0_6) {
    bool closed = false;
    int silent_ms = 0;
    std::uint32_t error = 0;
    for (int tick = 0; tick < 800 && drive_.sample().status != drivers::kDeviceOk; ++tick) {
      now_ns_ += 1'000'000;
      if (silent_ms > 20) {
        closed = false;
        error = is_0_6 ? 0x0100'0000 : 0x800;
      }
      drive_.take({.time_ns = now_ns_, .frame = heartbeat(closed ? 8 : 1, error)});
      drive_.take({.time_ns = now_ns_, .frame = estimates(turns_, 0.0F)});
      drivers::CanOutbox outbox;
      drive_.command(now_ns_, {.torque_Nm = 1.0, .enable = true}, outbox);
      properties_.check_outbox(drive_.sample(), outbox, torque_of);
      silent_ms = outbox.frames().empty() ? silent_ms + 1 : 0;
      for (const hal::CanFrame& frame : outbox.frames()) {
        if (frame.id == kFirstId && is_0_6) {
          hal::CanFrame version{.id = kFirstId, .length = 8};
          version.data[0] = std::byte{2};
          drive_.take({.time_ns = now_ns_, .frame = version});
        } else if (frame.id == (kFirstId | 0x07U)) {
          closed = frame.data[0] == std::byte{8};
        } else if (frame.id == (kFirstId | 0x18U)) {
          error = 0;
        }
      }
    }
  }

  drivers::ODriveCan drive_{kAxis};
  DriveProperties properties_{kLimits};
  hal::TimeNs now_ns_ = 1'000'000'000;
  float turns_ = 0.25F;
};

}  // namespace tactus::fuzz
