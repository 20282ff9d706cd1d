// Sends the run to every program that connects to a Unix socket. The stream is a sequence of
// messages, each after its length as a 32-bit little-endian number. The first message is the run's
// information (run_info.fbs); ticks (record.fbs) and events (event.fbs) follow. Bytes 4 to 7 of a
// message are its type: "TRUN", "TREC", "TEVT", "TEXP" or "TPLC". A reader that sends the byte 'x'
// gets explanations (explanation.fbs), too, until it sends 'o', and one that sends 'p' the places
// of the objects that move (object_places.fbs); other bytes are ignored.
//
// Each reader has a bounded buffer. A message that does not fit is skipped for that reader and
// counted. So a slow reader misses ticks, a stuck one is disconnected after kPatience_ns, and
// neither affects the others. It never waits. Not real time; one thread.
#pragma once

#include <sys/un.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/clock.h"
#include "hal/linux/system.h"

namespace tactus::firmware {

// The readers and what happened to them.
struct LiveCounts {
  // The readers that are connected now.
  std::uint32_t readers = 0;
  // The readers accepted since the start, like the numbers below.
  std::uint64_t accepted = 0;
  // The readers refused because all places were taken.
  std::uint64_t refused = 0;
  // The readers that disconnected or read nothing for kPatience_ns.
  std::uint64_t lost = 0;
  // The messages skipped, summed over the readers.
  std::uint64_t skipped = 0;
};

// The bytes with which a reader asks for explanations, and for no more of them.
inline constexpr std::byte kWantExplanations{'x'};
inline constexpr std::byte kWantNoExplanations{'o'};
// The byte with which a reader asks for places.
inline constexpr std::byte kWantPlaces{'p'};

// The messages that are sent to readers who want them.
struct LiveWishes {
  bool explanations = false;
  bool places = false;
};

// The socket of one run.
class LiveSocket {
 public:
  // The largest number of readers connected at once.
  static constexpr std::size_t kMaxReaders = 8;
  // The size of each reader's buffer.
  static constexpr std::size_t kBufferBytes = std::size_t{256} << 10U;
  // A reader that reads nothing for this time while messages wait for it is disconnected.
  static constexpr hal::TimeNs kPatience_ns = 10'000'000'000;

  LiveSocket() = default;
  LiveSocket(const LiveSocket&) = delete;
  LiveSocket& operator=(const LiveSocket&) = delete;
  ~LiveSocket() { close(); }

  // Creates the socket, readable for owner and group. Replaces a socket on which no program listens
  // any more. Returns 0 or errno: EADDRINUSE if another program listens there, ENAMETOOLONG.
  int open(const char* path);
  // Closes the socket and removes its file.
  void close();
  // Returns true between open() and close().
  [[nodiscard]] bool is_open() const { return listening_.is_open(); }

  // Accepts the waiting readers; each gets `greeting` as its first message.
  void accept_readers(std::span<const std::byte> greeting, hal::TimeNs now_ns);
  // Reads what the readers ask for. Returns what at least one of them wants.
  LiveWishes hear_readers();
  // Puts a message into the buffer of every reader.
  void publish(std::span<const std::byte> message);
  // Puts an explanation into the buffer of every reader that wants them.
  void publish_explanation(std::span<const std::byte> message);
  // Puts places into the buffer of every reader that wants them.
  void publish_places(std::span<const std::byte> message);
  // Sends as much of the buffers as the readers take now.
  void send(hal::TimeNs now_ns);

  // Returns the numbers of readers and messages.
  [[nodiscard]] const LiveCounts& counts() const { return counts_; }

 private:
  // A reader with its buffer, of which [begin, end) waits to be sent.
  struct Reader {
    hal::FileDescriptor socket;
    std::size_t begin = 0;
    std::size_t end = 0;
    // The time when it last read something or its buffer was empty.
    hal::TimeNs moved_ns = 0;
    LiveWishes wishes;
    std::array<std::byte, kBufferBytes> buffer{};
  };

  // Puts a message with its length into the buffer, or skips it.
  void append(Reader& reader, std::span<const std::byte> message);
  // Sends as much as the reader takes now.
  void send_to(Reader& reader, hal::TimeNs now_ns);
  // Disconnects a reader.
  void let_go(Reader& reader);

  hal::FileDescriptor listening_;
  sockaddr_un address_{};
  std::array<Reader, kMaxReaders> readers_{};
  LiveCounts counts_;
};

}  // namespace tactus::firmware
