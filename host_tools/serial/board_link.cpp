#include "host_tools/serial/board_link.h"

#include <utility>

namespace tactus::host {

BoardLink::BoardLink(const SerialPlace& place, HearText text)
    : line_(place), text_(std::move(text)) {
  frame_.reserve(firmware::kMaxFrame);
}

void BoardLink::write(std::span<const std::byte> message) {
  frame_.clear();
  firmware::put_frame(message, [this](std::byte byte) { frame_.push_back(byte); });
  line_.write(frame_);
}

void BoardLink::listen(hal::TimeNs deadline_ns, const Hear& hear) {
  std::array<std::byte, 16384> room{};
  const std::size_t count = line_.read(room, deadline_ns);
  bytes_ += count;
  for (const std::byte byte : std::span(room).first(count)) {
    const firmware::Heard heard = reader_.take(byte);
    if (!heard.text.empty()) {
      add_text(heard.text);
    }
    if (!heard.message.empty()) {
      heard_ns_ = hal::monotonic_now_ns();
      hear(heard.message);
    }
  }
}

void BoardLink::add_text(std::string_view text) {
  // A line of noise must not grow for ever.
  constexpr std::size_t kLongestText = 400;
  for (const char character : text) {
    const bool is_end = character == '\n' || text_line_.size() == kLongestText;
    if (is_end && text_ && !text_line_.empty()) {
      text_(text_line_);
    }
    if (is_end) {
      text_line_.clear();
    } else if (character >= ' ' && character <= '~') {
      text_line_ += character;
    }
  }
}

}  // namespace tactus::host
