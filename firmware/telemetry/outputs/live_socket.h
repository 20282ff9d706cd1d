// Gives the run to whoever connects to a Unix socket: a stream of messages, each behind its length
// as a 32-bit little-endian number. The first is the run's information (run_info.fbs), then come
// ticks (record.fbs) and events (event.fbs); bytes 4 to 7 of each message say which ("TRUN",
// "TREC", "TEVT"). Readers only read.
//
// Each reader has a bounded buffer. A message that does not fit whole is skipped for that reader
// and counted: a slow reader misses ticks, a stuck one loses its place after a while, and neither
// costs the others anything. Never waits. Not real time; one thread.
#pragma once

#include <sys/un.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/clock.h"
#include "hal/linux/system.h"

namespace tactus::firmware {

struct LiveCounts {
  std::uint32_t readers = 0;   // now
  std::uint64_t accepted = 0;  // since the start, as all below
  std::uint64_t refused = 0;   // readers, for want of a place
  std::uint64_t lost = 0;      // readers that went, or took nothing for kPatience_ns
  std::uint64_t skipped = 0;   // messages, summed over the readers
};

class LiveSocket {
 public:
  static constexpr std::size_t kMaxReaders = 8;
  static constexpr std::size_t kBufferBytes = std::size_t{256} << 10U;
  // A reader that takes nothing for so long while there is something for it is let go.
  static constexpr hal::TimeNs kPatience_ns = 10'000'000'000;

  LiveSocket() = default;
  LiveSocket(const LiveSocket&) = delete;
  LiveSocket& operator=(const LiveSocket&) = delete;
  ~LiveSocket() { close(); }

  // Makes the socket, of which owner and group may read; takes the place of one that nobody listens
  // to any more. 0, or errno: EADDRINUSE if another program listens there, ENAMETOOLONG.
  int open(const char* path);
  // Removes it.
  void close();
  [[nodiscard]] bool is_open() const { return listening_.is_open(); }

  // Lets in who waits, each with this as its first message.
  void accept_readers(std::span<const std::byte> greeting, hal::TimeNs now_ns);
  // For every reader.
  void publish(std::span<const std::byte> message);
  // Hands on as much as the readers take now.
  void send(hal::TimeNs now_ns);

  [[nodiscard]] const LiveCounts& counts() const { return counts_; }

 private:
  struct Reader {
    hal::FileDescriptor socket;
    std::size_t begin = 0;
    std::size_t end = 0;
    hal::TimeNs moved_ns = 0;  // when it last took something, or there was nothing for it
    std::array<std::byte, kBufferBytes> buffer{};
  };

  void append(Reader& reader, std::span<const std::byte> message);
  void send_to(Reader& reader, hal::TimeNs now_ns);
  void let_go(Reader& reader);

  hal::FileDescriptor listening_;
  sockaddr_un address_{};
  std::array<Reader, kMaxReaders> readers_{};
  LiveCounts counts_;
};

}  // namespace tactus::firmware
