// Sends ticks as JSON over UDP, one a datagram, as PlotJuggler's UDP server takes them. Never
// waits; nobody need listen. Not real time; one thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/telemetry/recorded_tick.h"
#include "hal/linux/system.h"

namespace tactus::firmware {

inline constexpr std::size_t kMaxDatagramBytes = 2000;
inline constexpr std::uint16_t kPlotJugglerPort = 9870;

// A tick as one JSON object, in `room`; numbers with nine digits, what is not finite as null.
std::span<const char> write_json(const RecordedTick& tick,
                                 std::array<char, kMaxDatagramBytes>& room);

class UdpJson {
 public:
  // To this port of this machine. 0, or errno.
  int open(std::uint16_t port);
  [[nodiscard]] bool is_open() const { return socket_.is_open(); }

  void send(const RecordedTick& tick);
  // Datagrams that the system did not take.
  [[nodiscard]] std::uint64_t failed() const { return failed_; }

 private:
  hal::FileDescriptor socket_;
  std::uint64_t failed_ = 0;
  std::array<char, kMaxDatagramBytes> room_{};
};

}  // namespace tactus::firmware
