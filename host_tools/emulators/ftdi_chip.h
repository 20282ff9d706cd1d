// The FTDI chip between a Falcon's USB cable and its processor, as far as the host sees it: the
// baud rate, the latency timer, and the packets to the host.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "hal/clock.h"

namespace tactus::host {

// One chip.
class FtdiChip {
 public:
  // Each packet to the host begins with this many status bytes.
  static constexpr std::size_t kStatusBytes = 2;

  // The divisor of the baud rate as the host has set it; 0 at power-up.
  void set_baud_divisor(std::uint16_t divisor) { baud_divisor_ = divisor; }
  [[nodiscard]] std::uint16_t baud_divisor() const { return baud_divisor_; }
  // Sets the time after which a packet without data is sent, at least 1 ms.
  void set_latency(std::uint16_t latency_ms);

  // Takes bytes of the processor, which may be sent from `due_ns` on.
  void queue(hal::TimeNs due_ns, std::span<const std::byte> bytes);
  // Drops the bytes that wait for the host.
  void drop_queue() { queue_.clear(); }

  // Returns when packet() will have something to send.
  [[nodiscard]] hal::TimeNs next_packet_ns() const;
  // Returns the next packet of at most `room` bytes: the status bytes with the data that is due, or
  // alone when the latency timer has run out. It is empty if nothing is due yet.
  std::vector<std::byte> packet(hal::TimeNs now_ns, std::size_t room);

 private:
  // A byte for the host and when it may be sent.
  struct Waiting {
    hal::TimeNs due_ns = 0;
    std::byte byte{};
  };

  std::uint16_t baud_divisor_ = 0;
  std::uint8_t latency_ms_ = 16;
  std::deque<Waiting> queue_;
  hal::TimeNs last_packet_ns_ = 0;
};

}  // namespace tactus::host
