// Lines of text and frames on their way to a UART, which takes them a character at a time beside
// the ticks. One thread; real time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "firmware/line/frame.h"

namespace tactus::firmware {

// The characters that may wait: a tick's frame, several answers, and the lines of a second.
inline constexpr std::size_t kLineQueueBytes = 2048;

// A ring of characters. A line or a frame for which it has no room is left out as a whole, and
// counted.
class LineQueue {
 public:
  // Adds a line and its end.
  void push(std::string_view line);
  // Adds the frame of a message (firmware/line/frame.h). Returns false if it was left out.
  bool push_frame(std::span<const std::byte> message);

  // Returns true if the frame of a message of so many bytes fits, and `spare` more characters.
  [[nodiscard]] bool has_room(std::size_t message_bytes, std::size_t spare = 0) const {
    return most_frame_bytes(message_bytes) + spare <= room_.size() - size_;
  }

  // Gives characters to `put` until it returns false or none is left.
  template <class Put>
  void pump(Put&& put) {
    while (size_ > 0 && put(room_[first_])) {
      first_ = (first_ + 1) % room_.size();
      --size_;
    }
  }

  // Returns the number of lines and frames that were left out.
  [[nodiscard]] std::uint32_t dropped() const { return dropped_; }

 private:
  void push_char(char character);

  std::array<char, kLineQueueBytes> room_{};
  std::size_t first_ = 0;
  std::size_t size_ = 0;
  std::uint32_t dropped_ = 0;
};

}  // namespace tactus::firmware
