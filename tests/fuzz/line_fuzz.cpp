// A serial line on any bytes, in both directions: whatever arrives is text, is left out, or is a
// message that is written as it was read; and every message is found behind them.
#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "firmware/line/frame.h"
#include "firmware/line/message.h"
#include "tests/fuzz/fuzz_input.h"

namespace tactus {
namespace {

using namespace firmware;  // NOLINT(google-build-using-namespace)

template <class Message>
void check_read(std::span<const std::byte> bytes) {
  Message message;
  if (!read_message(bytes, message)) {
    return;
  }
  std::array<std::byte, kMaxMessage> room{};
  fuzz::require(std::ranges::equal(write_message(message, room), bytes),
                "a message is written as it was read");
}

void check_message(std::span<const std::byte> bytes) {
  check_read<Hello>(bytes);
  check_read<RecordedTick>(bytes);
  check_read<Answer>(bytes);
  check_read<ImagePart>(bytes);
  check_read<AskHello>(bytes);
  check_read<AskTicks>(bytes);
  check_read<AskImage>(bytes);
  check_read<Command>(bytes);
  check_read<LineStop>(bytes);
  check_read<Alive>(bytes);
  check_read<Release>(bytes);
}

// Checks the bytes as what a line carries, with a frame behind them.
void check_line(std::span<const std::byte> bytes) {
  FrameReader reader;
  std::size_t text = 0;
  const auto take = [&](std::byte byte) {
    const Heard heard = reader.take(byte);
    text += heard.text.size();
    if (!heard.message.empty()) {
      check_message(heard.message);
    }
    return heard;
  };
  for (const std::byte byte : bytes) {
    take(byte);
  }
  fuzz::require(text <= bytes.size(), "no text comes from nowhere");
  const std::array<std::byte, 1> last{static_cast<std::byte>(MessageType::alive)};
  bool is_found = false;
  put_frame(last, [&](std::byte byte) { is_found = std::ranges::equal(take(byte).message, last); });
  fuzz::require(is_found, "a frame is found whatever came before");
}

// Checks the bytes as a message.
void check_as_message(std::span<const std::byte> bytes) {
  check_message(bytes);
  if (bytes.empty() || bytes.size() > kMaxMessage || !begins_message(bytes.front())) {
    return;
  }
  FrameReader reader;
  bool is_found = false;
  put_frame(bytes, [&](std::byte byte) {
    is_found = std::ranges::equal(reader.take(byte).message, bytes);
  });
  fuzz::require(is_found && reader.broken() == 0, "a message arrives");
}

}  // namespace
}  // namespace tactus

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto bytes = std::as_bytes(std::span(data, size));
  if (size > 0 && data[0] % 2 == 0) {
    tactus::check_line(bytes.subspan(1));
  } else {
    tactus::check_as_message(bytes.subspan(std::min<std::size_t>(size, 1)));
  }
  return 0;
}
