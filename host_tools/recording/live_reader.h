// Reads the live socket of a running tactusd.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "hal/linux/system.h"
#include "host_tools/recording/record_decoder.h"

namespace tactus::host {

inline constexpr const char* kLiveSocketFile = "telemetry.sock";  // in the run folder

using LiveMessage = std::variant<RunInfo, firmware::RecordedTick, firmware::TelemetryEvent>;

class LiveReader {
 public:
  // Throws InputError, with what to do, if nobody answers at that socket.
  explicit LiveReader(const std::string& socket);

  // The next message, for which it waits no longer than `patience`; empty if none came, or if the
  // run has ended. Messages that a reader was too slow for are missing: ticks are numbered. What
  // this version does not know is left out. Throws InputError if it is no stream of messages.
  std::optional<LiveMessage> next(std::chrono::milliseconds patience);

  // Returns true if the other side has closed and `next` has given out everything that came.
  [[nodiscard]] bool ended() const { return ended_; }
  // Returns the socket's descriptor for a poll by the caller. `next` may still have messages when
  // there is nothing to read.
  [[nodiscard]] int descriptor() const { return socket_.get(); }

 private:
  std::optional<std::span<const std::byte>> take_message();
  bool receive(std::chrono::milliseconds patience);

  std::string name_;
  hal::FileDescriptor socket_;
  std::vector<std::byte> buffer_;
  std::size_t begin_ = 0;
  bool ended_ = false;
};

}  // namespace tactus::host
