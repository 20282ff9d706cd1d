// Sends ticks as JSON over UDP, one per datagram, for PlotJuggler's UDP server. It never waits and
// needs no listener. Not real time; one thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/telemetry/recorded_tick.h"
#include "hal/linux/system.h"

namespace tactus::firmware {

// The largest size of a datagram. No tick's text is longer.
inline constexpr std::size_t kMaxDatagramBytes = 2000;
// The port that PlotJuggler's UDP server suggests.
inline constexpr std::uint16_t kPlotJugglerPort = 9870;

// The rate at which programs send ticks, 1/s: PlotJuggler draws a hundred points a second.
inline constexpr double kUdpRate_Hz = 100.0;

// Writes a tick into `room` as one JSON object and returns the text. Numbers have nine digits;
// values that are not finite become null.
std::span<const char> write_json(const RecordedTick& tick,
                                 std::array<char, kMaxDatagramBytes>& room);

// The socket of one run.
class UdpJson {
 public:
  // Opens the socket to a port of this machine. Returns 0 or errno.
  int open(std::uint16_t port);
  // Returns true after open() has succeeded.
  [[nodiscard]] bool is_open() const { return socket_.is_open(); }

  // Sends one tick, or drops it if the system takes no datagram now.
  void send(const RecordedTick& tick);
  // Returns the number of datagrams that the system did not take.
  [[nodiscard]] std::uint64_t failed() const { return failed_; }

 private:
  hal::FileDescriptor socket_;
  std::uint64_t failed_ = 0;
  std::array<char, kMaxDatagramBytes> room_{};
};

}  // namespace tactus::firmware
