#include "firmware/line/frame.h"

#include <gtest/gtest.h>

#include <deque>
#include <string>
#include <vector>

#include "tests/support/share.h"
#include "tests/unit/hal/random.h"

namespace tactus::firmware {
namespace {

using Bytes = std::vector<std::byte>;

Bytes bytes_of(std::initializer_list<int> numbers) {
  Bytes bytes;
  bytes.reserve(numbers.size());
  for (const int number : numbers) {
    bytes.push_back(static_cast<std::byte>(number));
  }
  return bytes;
}

Bytes bytes_of(std::string_view text) {
  const auto raw = std::as_bytes(std::span(text));
  return {raw.begin(), raw.end()};
}

// The bytes from `first` to `last`, both included.
Bytes row(int first, int last) {
  Bytes bytes;
  for (int i = first; i <= last; ++i) {
    bytes.push_back(static_cast<std::byte>(i));
  }
  return bytes;
}

Bytes operator+(Bytes left, const Bytes& right) {
  left.insert(left.end(), right.begin(), right.end());
  return left;
}

Bytes cobs_of(const Bytes& plain) {
  Bytes stuffed;
  put_cobs(
      plain.size(), [&](std::size_t i) { return plain[i]; },
      [&](std::byte byte) { stuffed.push_back(byte); });
  return stuffed;
}

Bytes frame_of(const Bytes& message) {
  Bytes frame;
  put_frame(message, [&](std::byte byte) { frame.push_back(byte); });
  return frame;
}

// Everything that a reader finds in a line.
struct HeardLine {
  std::vector<Bytes> messages;
  std::string text;
};

HeardLine heard_in(FrameReader& reader, const Bytes& line) {
  HeardLine found;
  for (const std::byte byte : line) {
    const Heard heard = reader.take(byte);
    if (!heard.message.empty()) {
      found.messages.emplace_back(heard.message.begin(), heard.message.end());
    }
    found.text += heard.text;
  }
  return found;
}

// A message of random bytes, with zeros more often than by chance.
Bytes random_message(hal::Random& random, std::uint32_t most) {
  Bytes message(1 + random.below(most));
  const std::size_t zero_of = 1 + random.below(300);
  for (std::byte& byte : message) {
    byte = random.below(zero_of) == 0 ? std::byte{0} : static_cast<std::byte>(random.below(256));
  }
  message.front() = std::byte{0x02};
  return message;
}

TEST(LineFrame, StuffsTheBytesOfThePaperAsThePaperDoes) {
  // Cheshire and Baker, "Consistent Overhead Byte Stuffing", figure 3: the head of an IP packet.
  EXPECT_EQ(
      cobs_of(bytes_of({0x45, 0x00, 0x00, 0x2C, 0x4C, 0x79, 0x00, 0x00, 0x40, 0x06, 0x4F, 0x37})),
      bytes_of({0x02, 0x45, 0x01, 0x04, 0x2C, 0x4C, 0x79, 0x01, 0x05, 0x40, 0x06, 0x4F, 0x37}));
}

TEST(LineFrame, StuffsTheExamplesOfTheEncyclopediaAsItsTableSays) {
  // Wikipedia, "Consistent Overhead Byte Stuffing", the table of encoding examples.
  const std::array<std::pair<Bytes, Bytes>, 11> table{{
      {bytes_of({0x00}), bytes_of({0x01, 0x01})},
      {bytes_of({0x00, 0x00}), bytes_of({0x01, 0x01, 0x01})},
      {bytes_of({0x00, 0x11, 0x00}), bytes_of({0x01, 0x02, 0x11, 0x01})},
      {bytes_of({0x11, 0x22, 0x00, 0x33}), bytes_of({0x03, 0x11, 0x22, 0x02, 0x33})},
      {bytes_of({0x11, 0x22, 0x33, 0x44}), bytes_of({0x05, 0x11, 0x22, 0x33, 0x44})},
      {bytes_of({0x11, 0x00, 0x00, 0x00}), bytes_of({0x02, 0x11, 0x01, 0x01, 0x01})},
      {row(0x01, 0xFE), bytes_of({0xFF}) + row(0x01, 0xFE)},
      {row(0x00, 0xFE), bytes_of({0x01, 0xFF}) + row(0x01, 0xFE)},
      {row(0x01, 0xFF), bytes_of({0xFF}) + row(0x01, 0xFE) + bytes_of({0x02, 0xFF})},
      {row(0x02, 0xFF) + bytes_of({0x00}),
       bytes_of({0xFF}) + row(0x02, 0xFF) + bytes_of({0x01, 0x01})},
      {row(0x03, 0xFF) + bytes_of({0x00, 0x01}),
       bytes_of({0xFE}) + row(0x03, 0xFF) + bytes_of({0x02, 0x01})},
  }};
  for (const auto& [plain, stuffed] : table) {
    EXPECT_EQ(cobs_of(plain), stuffed);
  }
}

TEST(LineFrame, HasTheChecksumOfTheMessageLeastSignificantByteFirst) {
  // 0xCBF43926 is the check value of CRC-32 in every catalogue.
  EXPECT_EQ(crc32(bytes_of("123456789")), 0xCBF43926U);
  EXPECT_EQ(frame_of(bytes_of("123456789")), bytes_of({0x00, 0x0E}) + bytes_of("123456789") +
                                                 bytes_of({0x26, 0x39, 0xF4, 0xCB, 0x00}));
}

TEST(LineFrame, AReaderFindsEveryMessageAndEveryCharacterBetweenThem) {
  hal::Random random(11);
  FrameReader reader;
  for (int i = tactus::testing::share_of(3'000); i > 0; --i) {
    HeardLine sent;
    Bytes line;
    for (std::uint32_t part = 0; part < 5; ++part) {
      if (random.below(2) == 0) {
        sent.messages.push_back(random_message(random, kMaxMessage));
        const Bytes frame = frame_of(sent.messages.back());
        ASSERT_LE(frame.size(), most_frame_bytes(sent.messages.back().size()));
        ASSERT_EQ(std::ranges::count(frame, std::byte{0}), 2);
        line = line + frame;
      } else {
        std::string text(2 + random.below(60), '.');
        for (char& character : text) {
          character = static_cast<char>(' ' + random.below(95));
        }
        text += "\r\n";
        sent.text += text;
        line = line + bytes_of(text);
      }
    }
    const HeardLine found = heard_in(reader, line);
    ASSERT_EQ(found.text, sent.text);
    ASSERT_EQ(found.messages, sent.messages);
  }
  EXPECT_EQ(reader.broken(), 0U);
}

TEST(LineFrame, ABitThatFlipsNeverMakesAnotherMessage) {
  hal::Random random(12);
  for (int i = tactus::testing::share_of(30); i > 0; --i) {
    const Bytes message = random_message(random, 60);
    const Bytes frame = frame_of(message);
    for (std::size_t bit = 0; bit < 8 * frame.size(); ++bit) {
      Bytes line = frame;
      line[bit / 8] ^= std::byte{1} << (bit % 8);
      FrameReader reader;
      // The next frame is found whatever came before it, but for one whose first zero ends the
      // damaged one.
      const HeardLine found = heard_in(reader, line + frame + frame);
      ASSERT_GE(found.messages.size(), 1U);
      for (const Bytes& read : found.messages) {
        ASSERT_EQ(read, message);
      }
      ASSERT_EQ(found.messages.size() + reader.broken() >= 2, true);
    }
  }
}

TEST(LineFrame, AReaderThatBeginsWithinAFrameFindsTheNextOne) {
  const Bytes message = bytes_of({0x02, 0x00, 0x07});
  const Bytes frame = frame_of(message);
  for (std::size_t begin = 1; begin < frame.size(); ++begin) {
    const Bytes rest(frame.begin() + static_cast<std::ptrdiff_t>(begin), frame.end());
    FrameReader reader;
    EXPECT_EQ(heard_in(reader, rest + frame).messages, std::vector<Bytes>{message});
  }
}

TEST(LineFrame, ALineAfterAFrameThatWasNeverFinishedIsTextOnceAZeroHasCome) {
  FrameReader reader;
  Bytes line = frame_of(bytes_of({0x02, 0x01, 0x02, 0x03}));
  line.resize(line.size() - 3);
  const HeardLine found =
      heard_in(reader, line + bytes_of({0x00}) + bytes_of("stop 1 watchdog\r\n"));
  EXPECT_EQ(found.text, "stop 1 watchdog\r\n");
  EXPECT_TRUE(found.messages.empty());
  EXPECT_EQ(reader.broken(), 1U);
}

TEST(LineFrame, AFrameThatIsTooLongIsLeftOutAndTheNextOneIsFound) {
  const Bytes message = bytes_of({0x02, 0x07});
  for (const std::size_t size : {kMaxMessage, kMaxMessage + 1, 3 * kMaxMessage}) {
    FrameReader reader;
    const Bytes large(size, std::byte{0x02});
    const HeardLine found = heard_in(reader, frame_of(large) + frame_of(message));
    EXPECT_EQ(found.messages.back(), message);
    EXPECT_EQ(found.messages.size(), size == kMaxMessage ? 2U : 1U);
    EXPECT_EQ(reader.broken(), size == kMaxMessage ? 0U : 1U);
  }
}

TEST(LineFrame, AFrameWithoutAMessageIsBroken) {
  FrameReader reader;
  // A type byte at a block's end, and a checksum without a message.
  EXPECT_TRUE(heard_in(reader, bytes_of({0x00, 0x02, 0x02, 0x00})).messages.empty());
  EXPECT_TRUE(heard_in(reader, bytes_of({0x05, 0x02, 0x03, 0x04, 0x05, 0x00})).messages.empty());
  EXPECT_TRUE(heard_in(reader, bytes_of({0x00, 0x00, 0x00})).messages.empty());
  EXPECT_EQ(reader.broken(), 2U);
}

TEST(LineFrame, NoCharacterOfALineBeginsAMessage) {
  for (int i = 0; i < 256; ++i) {
    const bool is_of_text = i == '\t' || i == '\n' || i == '\r' || i >= ' ';
    EXPECT_EQ(begins_message(static_cast<std::byte>(i)), i != 0 && !is_of_text) << i;
  }
}

}  // namespace
}  // namespace tactus::firmware
