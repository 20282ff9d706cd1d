// One random life of a drive on a CAN bus, and the bring-up that comes before it.
#pragma once

#include <cstdint>

#include "tests/fuzz/drive_properties.h"
#include "tests/fuzz/fuzz_input.h"

namespace tactus::fuzz {

// `Peer` plays the real drive at the other end of the bus:
//   Drive, kConfig, kLimits, kMostTicks   the driver, its configuration and limits, and how many
//                                         ticks its bring-up may take
//   Peer(std::uint8_t how)                `how` is the input's first byte; bit 0 is taken
//   torque_of(frame)                      static: the torque that a frame commands, N m, decoded
//                                         without the driver's code
//   random_frame(input)                   any frame; some make sense
//   speak(now_ns, send)                   sends what a healthy drive sends in one tick
//   hear(frame, now_ns, send)             takes a frame of the driver and sends the answers
template <class Peer>
class DriveLife {
 public:
  // Ends the program if a property breaks. Bit 0 of the input asks for a bring-up.
  void run(FuzzInput input) {
    const auto how = input.take<std::uint8_t>();
    Peer peer(how);
    drive_.start(now_ns_);
    if ((how & 1U) != 0) {
      bring_up(peer);
    }
    fuzz_drive(drive_, properties_, now_ns_, input, Peer::torque_of,
               [&peer](FuzzInput& bytes) { return peer.random_frame(bytes); });
  }

  // Returns true if the bring-up works. Without it the random lives would test next to nothing.
  [[nodiscard]] bool comes_up(std::uint8_t how = 0) {
    Peer peer(how);
    drive_.start(now_ns_);
    bring_up(peer);
    return drive_.sample().status == drivers::kDeviceOk;
  }

 private:
  void bring_up(Peer& peer) {
    const auto send = [this](const hal::CanFrame& frame) {
      drive_.take({.time_ns = now_ns_, .frame = frame});
    };
    for (int tick = 0; tick < Peer::kMostTicks && drive_.sample().status != drivers::kDeviceOk;
         ++tick) {
      now_ns_ += 1'000'000;
      drivers::CanOutbox outbox;
      drive_.request(now_ns_, outbox);
      properties_.check_outbox(drive_.sample(), outbox, Peer::torque_of);
      peer.speak(now_ns_, send);
      outbox.clear();
      drive_.command(now_ns_, {.torque_Nm = 1.0, .enable = true}, outbox);
      properties_.check_outbox(drive_.sample(), outbox, Peer::torque_of);
      for (const hal::CanFrame& frame : outbox.frames()) {
        peer.hear(frame, now_ns_, send);
      }
    }
  }

  typename Peer::Drive drive_{Peer::kConfig};
  DriveProperties properties_{Peer::kLimits};
  hal::TimeNs now_ns_ = 1'000'000'000;
};

}  // namespace tactus::fuzz
