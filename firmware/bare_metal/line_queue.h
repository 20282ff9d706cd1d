// Lines on their way to a UART, which takes them a character at a time beside the ticks. One
// thread; real time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace tactus::firmware {

// A ring of characters. A line for which it has no room is left out as a whole, and counted.
class LineQueue {
 public:
  // Adds a line and its end.
  void push(std::string_view line);

  // Gives characters to `put` until it returns false or none is left.
  template <class Put>
  void pump(Put&& put) {
    while (size_ > 0 && put(room_[first_])) {
      first_ = (first_ + 1) % room_.size();
      --size_;
    }
  }

  // Returns the number of lines that were left out.
  [[nodiscard]] std::uint32_t dropped() const { return dropped_; }

 private:
  void push_char(char character);

  std::array<char, 1024> room_{};
  std::size_t first_ = 0;
  std::size_t size_ = 0;
  std::uint32_t dropped_ = 0;
};

}  // namespace tactus::firmware
