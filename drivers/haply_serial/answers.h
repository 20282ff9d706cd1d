// Finds the answers of a Haply board in its bytes, and the time of the command to each.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "drivers/common/question_times.h"
#include "drivers/haply_serial/protocol.h"
#include "hal/clock.h"

namespace tactus::drivers {

// The bytes of a whole answer, valid until the next are received, and the time at which its command
// was sent; nothing if no command is open.
struct HaplyAnswer {
  std::span<const std::byte> bytes;
  std::optional<hal::TimeNs> asked_ns;
};

// The board answers in turn, and all its answers have the same length.
class HaplyAnswers {
 public:
  // `axes` is from 1 to kHaplyMaxAxes.
  explicit HaplyAnswers(std::size_t axes) : whole_(haply_reply_bytes(axes)) {}

  // Forgets the commands and the bytes.
  void restart() {
    drop_piece();
    commands_ = {};
  }
  // Notes that a command was sent.
  void ask(hal::TimeNs now_ns) { commands_.ask(now_ns); }

  // Returns the room for the rest of the answer that is arriving.
  [[nodiscard]] std::span<std::byte> room() {
    return std::span(bytes_).first(whole_).subspan(size_);
  }
  // Takes so many bytes, which were received into `room`. Returns the answer that they end, if any.
  std::optional<HaplyAnswer> take(std::size_t received);
  // Ends a read. Returns true if a part of an answer came too late: it is dropped, and counts as
  // the answer to its command.
  bool drop_late_piece();

  // Returns true if a command has no answer yet.
  [[nodiscard]] bool is_awaited() const { return commands_.is_open(); }

 private:
  void drop_piece() {
    size_ = 0;
    late_reads_ = 0;
  }

  // The size of a whole answer, bytes.
  std::size_t whole_;
  // The answer that is arriving, and the size of the part that is there.
  std::array<std::byte, haply_reply_bytes(kHaplyMaxAxes)> bytes_{};
  std::size_t size_ = 0;
  // The number of reads that ended with that part.
  std::uint32_t late_reads_ = 0;
  QuestionTimes commands_;
};

}  // namespace tactus::drivers
