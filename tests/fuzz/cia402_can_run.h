// The CiA 402 drive of a random life: DriveLife of drive_life.h.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>

#include "drivers/cia402_can/cia402_can.h"
#include "tests/fuzz/drive_life.h"
#include "tests/fuzz/fuzz_input.h"

namespace tactus::fuzz {

class Cia402Peer {
 public:
  using Drive = drivers::Cia402Can;
  static constexpr int kMostTicks = 200;

  // The rated torque stands as configured, so that the torque on the wire can be told without the
  // driver: 0.1 % of 1 N m.
  static constexpr drivers::Cia402Config kConfig{
      .node = 1,
      .max_torque_Nm = 0.1,
      .rated_torque_from = drivers::RatedTorque::configured,
      .rated_torque_Nm = 1.0,
      .max_speed_rad_per_s = 100.0,
      .jump_margin_rad = 0.05,
      .sdo_timeout_s = 0.05};

  // Samples of one SYNC may lie a margin apart from the first of them, which is not always seen
  // here.
  static constexpr DriveLimits kLimits{.max_torque_Nm = kConfig.max_torque_Nm,
                                       .max_speed_rad_per_s = kConfig.max_speed_rad_per_s,
                                       .jump_margin_rad = 2.0 * kConfig.jump_margin_rad};

  // Decoded by hand: the torque of RPDO1.
  static double torque_of(const hal::CanFrame& frame) {
    if (frame.id != 0x201) {
      return 0.0;
    }
    std::int16_t units = 0;
    std::memcpy(&units, &frame.data[2], sizeof units);
    return 1e-3 * units;
  }

  explicit Cia402Peer(std::uint8_t /*how*/) {}

  // Some frames make sense, or the axis would never be well for long.
  hal::CanFrame random_frame(FuzzInput& bytes) {
    constexpr std::array<std::uint32_t, 6> kServices = {0x181, 0x281, 0x081, 0x581, 0x701, 0x000};
    switch (bytes.below(10)) {
      case 0:
      case 1:
        return heartbeat(std::byte{0x05});
      case 2:
        return motion();
      case 3:
      case 4:
      case 5:
      case 6:
        count_ += static_cast<std::uint32_t>(bytes.take<std::int8_t>());
        controlword_ = bytes.below(64) == 0 ? controlword_ : std::byte{0x0F};
        return state();
      case 7:
        return bytes.frame(bytes.below(0x800));
      default:
        return bytes.frame(kServices[bytes.below(kServices.size())]);
    }
  }

  template <class Send>
  void speak(hal::TimeNs now_ns, Send send) {
    watch_host(now_ns, send);
    if (heartbeat_ == std::byte{0x05}) {
      send(state());
      send(motion());
      send(heartbeat(heartbeat_));
    }
  }

  template <class Send>
  void hear(const hal::CanFrame& frame, hal::TimeNs now_ns, Send send) {
    if (frame.id == 0x000) {
      heartbeat_ = frame.data[0] == std::byte{0x01} ? std::byte{0x05} : std::byte{0x00};
      send(heartbeat(heartbeat_));
    } else if (frame.id == 0x601) {
      send(answer_to(frame));
    } else if (frame.id == 0x201) {
      has_tripped_ = has_tripped_ && frame.data[0] != std::byte{0x80};
      controlword_ = frame.data[0];
    } else if (frame.id == 0x77F) {
      host_ns_ = now_ns;
    }
  }

 private:
  static hal::CanFrame heartbeat(std::byte state) {
    hal::CanFrame frame{.id = 0x701, .length = 1};
    frame.data[0] = state;
    return frame;
  }

  static hal::CanFrame motion() {
    hal::CanFrame frame{.id = 0x281, .length = 5};
    frame.data[4] = std::byte{10};
    return frame;
  }

  // Returns TPDO1 with the statusword that the controlword asks for.
  [[nodiscard]] hal::CanFrame state() const {
    hal::CanFrame frame{.id = 0x181, .length = 8};
    frame.data[0] = has_tripped_                      ? std::byte{0x18}
                    : controlword_ == std::byte{0x0F} ? std::byte{0x37}
                    : controlword_ == std::byte{0x07} ? std::byte{0x33}
                    : controlword_ == std::byte{0x06} ? std::byte{0x31}
                                                      : std::byte{0x50};
    frame.data[1] = std::byte{0x02};
    std::memcpy(&frame.data[2], &count_, sizeof count_);
    return frame;
  }

  // The watchdog of 20 ms: an emergency message, and a fault until it is reset.
  template <class Send>
  void watch_host(hal::TimeNs now_ns, Send send) {
    if (host_ns_ == 0 || now_ns - host_ns_ < 20'000'000) {
      return;
    }
    host_ns_ = 0;
    has_tripped_ = true;
    hal::CanFrame frame{.id = 0x081, .length = 8};
    frame.data[0] = std::byte{0x30};
    frame.data[1] = std::byte{0x81};
    send(frame);
  }

  static hal::CanFrame answer_to(const hal::CanFrame& question) {
    hal::CanFrame answer = question;
    answer.id = 0x581;
    if (question.data[0] != std::byte{0x40}) {
      answer.data[0] = std::byte{0x60};
      return answer;
    }
    answer.data[0] = std::byte{0x43};
    const bool is_type = question.data[1] == std::byte{0x00};  // 1000:00, else 6502:00
    answer.data[4] = is_type ? std::byte{0x92} : std::byte{0x00};
    answer.data[5] = is_type ? std::byte{0x01} : std::byte{0x02};
    return answer;
  }

  std::byte heartbeat_{0x7F};
  std::byte controlword_{0};
  hal::TimeNs host_ns_ = 0;  // when the host's heartbeat was last heard; 0: not since a trip
  bool has_tripped_ = false;
  std::uint32_t count_ = 0x7FFF'FF00;  // close to where it wraps
};

using Cia402Life = DriveLife<Cia402Peer>;

}  // namespace tactus::fuzz
