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

bool LineQueue::push_frame(std::span<const std::byte> message) {
  if (!has_room(message.size())) {
    ++dropped_;
    return false;
  }
  put_frame(message, [this](std::byte byte) { push_char(static_cast<char>(byte)); });
  return true;
}

void LineQueue::push_char(char character) {
  room_[(first_ + size_) % room_.size()] = character;
  ++size_;
}

}  // namespace tactus::firmware
