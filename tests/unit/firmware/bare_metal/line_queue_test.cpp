#include "firmware/bare_metal/line_queue.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <deque>
#include <string>

#include "tests/support/share.h"
#include "tests/unit/hal/random.h"

namespace tactus::firmware {
namespace {

constexpr std::size_t kQueueRoom = kLineQueueBytes;

// Returns what the queue gives to a UART that takes so many characters.
std::string pumped(LineQueue& queue, std::size_t room) {
  std::string text;
  queue.pump([&](char character) {
    if (text.size() == room) {
      return false;
    }
    text += character;
    return true;
  });
  return text;
}

TEST(LineQueue, GivesLinesInTheirOrderEachWithItsEnd) {
  LineQueue queue;
  queue.push("one");
  queue.push("");
  queue.push("three");
  EXPECT_EQ(pumped(queue, kQueueRoom), "one\r\n\r\nthree\r\n");
  EXPECT_EQ(pumped(queue, kQueueRoom), "");
}

TEST(LineQueue, OffersACharacterAgainThatTheUartHasNotTaken) {
  LineQueue queue;
  queue.push("line");
  EXPECT_EQ(pumped(queue, 0), "");
  EXPECT_EQ(pumped(queue, 3), "lin");
  EXPECT_EQ(pumped(queue, kQueueRoom), "e\r\n");
}

TEST(LineQueue, LeavesOutALineWithoutRoomAsAWhole) {
  const std::string filling(kQueueRoom - 2, 'x');
  LineQueue queue;
  queue.push(filling);
  EXPECT_EQ(queue.dropped(), 0U);
  queue.push("");
  EXPECT_EQ(queue.dropped(), 1U);
  EXPECT_EQ(pumped(queue, 1), "x");
  queue.push("");
  EXPECT_EQ(queue.dropped(), 2U) << "one character of room is too little for a line's end";
  EXPECT_EQ(pumped(queue, 2 * kQueueRoom), filling.substr(1) + "\r\n");
  queue.push("room again");
  EXPECT_EQ(pumped(queue, kQueueRoom), "room again\r\n");
}

TEST(LineQueue, LeavesOutAFrameWithoutRoomAsAWhole) {
  const std::array<std::byte, 100> message{std::byte{2}};
  const std::size_t frame = most_frame_bytes(message.size());
  LineQueue queue;
  queue.push(std::string(kQueueRoom - 2 - frame, 'x'));
  EXPECT_TRUE(queue.has_room(message.size()));
  EXPECT_FALSE(queue.has_room(message.size(), 1));
  EXPECT_FALSE(queue.has_room(message.size() + 1));
  EXPECT_TRUE(queue.push_frame(message));
  EXPECT_FALSE(queue.push_frame(message));
  EXPECT_EQ(queue.dropped(), 1U);
  const std::string text = pumped(queue, 2 * kQueueRoom);
  EXPECT_EQ(std::ranges::count(text.substr(text.find('\n')), '\0'), 2) << "one frame";
}

TEST(LineQueue, NeverLosesMixesOrRepeatsACharacter) {
  hal::Random random(7);
  LineQueue queue;
  std::deque<char> shadow;
  std::uint32_t dropped = 0;
  for (int i = testing::share_of(100'000); i > 0; --i) {
    std::string line(random.below(200), '.');
    for (char& character : line) {
      character = static_cast<char>('a' + random.below(26));
    }
    queue.push(line);
    line += "\r\n";
    if (shadow.size() + line.size() <= kQueueRoom) {
      shadow.insert(shadow.end(), line.begin(), line.end());
    } else {
      ++dropped;
    }
    const std::string text = pumped(queue, random.below(200));
    ASSERT_LE(text.size(), shadow.size());
    ASSERT_TRUE(std::equal(text.begin(), text.end(), shadow.begin()));
    shadow.erase(shadow.begin(), shadow.begin() + static_cast<std::ptrdiff_t>(text.size()));
  }
  EXPECT_EQ(queue.dropped(), dropped);
  EXPECT_EQ(pumped(queue, 2 * kQueueRoom), std::string(shadow.begin(), shadow.end()));
}

}  // namespace
}  // namespace tactus::firmware
