// Reads the live telemetry socket of a running tactusd or `tactus sim --serve`. `tactus watch` and
// the monitor call it, in their own process and in one thread; the controller never waits for a
// reader.
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

// The socket's name in the run folder.
inline constexpr const char* kLiveSocketFile = "telemetry.sock";

// A message of the live socket. The information about the run comes first, for every reader that
// connects.
using LiveMessage = std::variant<RunInfo, firmware::RecordedTick, firmware::TelemetryEvent,
                                 firmware::Explanation, firmware::ObjectPlaces>;

// A connection to one live socket, with the bytes that have not made a whole message yet.
class LiveReader {
 public:
  // Connects to the socket. Throws InputError that names the socket and the remedy if nobody
  // answers there or its path is too long for the system.
  explicit LiveReader(const std::string& socket);

  // Asks for explanations, which come from one of the next ticks on, or for no more of them. A
  // controller of an older version sends none; one that has ended is no error here.
  void ask_for_explanations(bool wanted);
  // Asks for the places of the objects that move, if the scene has any. A board sends none.
  void ask_for_places();

  // Returns the next message, and waits for it no longer than `patience`. Returns nothing if none
  // came or the run has ended. The sender drops messages for a reader that is too slow: a gap shows
  // in the numbers of the ticks. Messages of a kind that this version does not know are skipped.
  // Throws InputError if the bytes are no stream of telemetry messages.
  std::optional<LiveMessage> next(std::chrono::milliseconds patience);

  // Returns true if the other side has closed and `next` has given out everything that came.
  [[nodiscard]] bool ended() const { return ended_; }
  // Returns the socket's descriptor for a poll by the caller. `next` may still have messages when
  // there is nothing to read.
  [[nodiscard]] int descriptor() const { return socket_.get(); }

 private:
  // Returns the next whole message in the buffer, without its length; valid until receive().
  std::optional<std::span<const std::byte>> take_message();
  // Appends the bytes that arrive within `patience`. Returns false if none came.
  bool receive(std::chrono::milliseconds patience);

  // The socket's path, for messages to the user.
  std::string name_;
  hal::FileDescriptor socket_;
  std::vector<std::byte> buffer_;
  // The bytes of `buffer_` before this place were given out.
  std::size_t begin_ = 0;
  bool ended_ = false;
};

}  // namespace tactus::host
