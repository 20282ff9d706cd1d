#include "firmware/bare_metal/line_queue.h"

namespace tactus::firmware {

void LineQueue::push(std::string_view line) {
  if (line.size() + 2 > room_.size() - size_) {
    ++dropped_;
    return;
  }
  for (const char character : line) {
    push_char(character);
  }
  push_char('\r');
  push_char('\n');
}

void LineQueue::push_char(char character) {
  room_[(first_ + size_) % room_.size()] = character;
  ++size_;
}

}  // namespace tactus::firmware
