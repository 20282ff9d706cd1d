#include "firmware/line/frame.h"

#include "drivers/common/little_endian.h"

namespace tactus::firmware {

Heard FrameReader::take(std::byte byte) {
  if (byte == kFrameEnd) {
    return end();
  }
  switch (place_) {
    case Place::text:
      text_[0] = static_cast<char>(byte);
      return {.message = {}, .text = {text_.data(), 1}};
    case Place::first:
      text_[0] = static_cast<char>(byte);
      place_ = Place::second;
      break;
    case Place::second:
      // A message's first byte follows the byte of the block: COBS moves no byte but zeros.
      if (!begins_message(byte)) {
        text_[1] = static_cast<char>(byte);
        place_ = Place::text;
        return {.message = {}, .text = {text_.data(), 2}};
      }
      place_ = Place::inside;
      take_inside(static_cast<std::byte>(text_[0]));
      take_inside(byte);
      break;
    case Place::inside:
      take_inside(byte);
      break;
    case Place::skipping:
      break;
  }
  return {};
}

Heard FrameReader::end() {
  const Place place = place_;
  const std::size_t size = size_;
  const bool is_whole = left_ == 0;
  place_ = Place::first;
  size_ = 0;
  left_ = 0;
  zero_follows_ = false;
  if (place == Place::text || place == Place::first) {
    return {};
  }
  if (place == Place::inside && is_whole && size > kCrcBytes) {
    const auto message = std::span<const std::byte>(room_).first(size - kCrcBytes);
    if (drivers::load_little_endian<std::uint32_t>(room_, message.size()) == crc32(message)) {
      return {.message = message, .text = {}};
    }
  }
  ++broken_;
  return {};
}

void FrameReader::take_inside(std::byte byte) {
  if (left_ > 0) {
    --left_;
    add(byte);
    return;
  }
  if (zero_follows_) {
    add(std::byte{0});
  }
  left_ = std::to_integer<std::size_t>(byte) - 1;
  zero_follows_ = left_ < kCobsBlock;
}

void FrameReader::add(std::byte byte) {
  if (size_ == room_.size()) {
    place_ = Place::skipping;
    return;
  }
  room_[size_] = byte;
  ++size_;
}

}  // namespace tactus::firmware
