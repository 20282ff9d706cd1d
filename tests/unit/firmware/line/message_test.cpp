#include "firmware/line/message.h"

#include <gtest/gtest.h>

#include <bit>
#include <string>
#include <vector>

#include "firmware/line/message_fields.h"
#include "firmware/telemetry/record_fields.h"
#include "tests/support/share.h"
#include "tests/unit/hal/random.h"

namespace tactus::firmware {
namespace {

using Bytes = std::vector<std::byte>;

// The visits of every message by one name, with fields and without their names.
template <class Visit>
void visit_line_fields(auto& message, Visit&& visit) {
  using Message = std::remove_cvref_t<decltype(message)>;
  if constexpr (std::is_same_v<Message, Hello>) {
    visit_hello_fields(message, visit);
  } else if constexpr (std::is_same_v<Message, RecordedTick>) {
    visit_tick_fields(message, [&](const FieldName&, auto& field) { visit(field); });
  } else if constexpr (std::is_same_v<Message, Answer>) {
    visit_answer_fields(message, visit);
  } else if constexpr (std::is_same_v<Message, Command>) {
    visit_command_fields(message, visit);
  } else if constexpr (std::is_same_v<Message, AskTicks>) {
    visit_ask_ticks_fields(message, visit);
  } else if constexpr (std::is_same_v<Message, AskImage>) {
    visit_ask_image_fields(message, visit);
  } else if constexpr (std::is_same_v<Message, LineStop>) {
    visit_stop_fields(message, visit);
  }
}

template <class Message>
Bytes written(const Message& message) {
  std::array<std::byte, kMaxMessage> room{};
  const auto bytes = write_message(message, room);
  return {bytes.begin(), bytes.end()};
}

// The bytes of every field, one after the other.
template <class Message>
std::vector<Bytes> fields_of(const Message& message) {
  std::vector<Bytes> fields;
  visit_line_fields(message, [&]<class Field>(const Field& field) {
    const auto add = [&](const auto& value) {
      const auto raw = std::as_bytes(std::span(&value, 1));
      fields.emplace_back(raw.begin(), raw.end());
    };
    if constexpr (requires { field.number; }) {
      add(field.number);
    } else {
      add(field);
    }
  });
  return fields;
}

// Gives a number a value of its own that is in its range.
template <class Number>
void change_number(hal::Random& random, Number& number) {
  if constexpr (std::is_same_v<Number, BoardImage> || std::is_same_v<Number, CommandKind>) {
    number = static_cast<Number>(1 - static_cast<int>(number));
  } else if constexpr (std::is_enum_v<Number>) {
    number = static_cast<Number>((static_cast<std::uint32_t>(number) + 1 + random.below(2)) % 3);
  } else if constexpr (std::is_floating_point_v<Number>) {
    number = std::bit_cast<double>(std::uint64_t{random.below(1U << 30U)} << 33U | 0x1234567U);
  } else if constexpr (std::is_same_v<Number, char>) {
    number = static_cast<char>('a' + random.below(26));
  } else {
    number = static_cast<Number>(number + static_cast<Number>(1 + random.below(2)));
  }
}
template <class Number, std::size_t kCount>
void change_number(hal::Random& random, std::array<Number, kCount>& numbers) {
  for (Number& number : numbers) {
    change_number(random, number);
  }
}
void change_number(hal::Random& random, const LineSize<std::size_t>& size) {
  size.number = 1 + size.number % 2 + random.below(1);
}

// A message in which every field differs from a default one.
template <class Message>
Message changed_message(hal::Random& random) {
  Message message;
  visit_line_fields(message, [&]<class Field>(Field&& field) {
    change_number(random, std::forward<Field>(field));
  });
  if constexpr (std::is_same_v<Message, Hello>) {
    message.version = kLineVersion;
  }
  if constexpr (std::is_same_v<Message, Answer>) {
    message.scene_refusal.part.other_count = 3;
  }
  return message;
}

// All fields of a message arrive, and each by itself changes the bytes on the line.
template <class Message>
void expect_the_round_trip() {
  hal::Random random(21);
  for (int i = tactus::testing::share_of(200); i > 0; --i) {
    const auto sent = changed_message<Message>(random);
    Message got;
    ASSERT_TRUE(read_message(written(sent), got));
    ASSERT_EQ(fields_of(got), fields_of(sent));
    const auto before = fields_of(Message{});
    const auto after = fields_of(sent);
    for (std::size_t field = 0; field < before.size(); ++field) {
      if (!(std::is_same_v<Message, Hello> && field == 0)) {
        EXPECT_NE(before[field], after[field]) << "field " << field;
      }
    }
  }
}

// No message that is cut, or has more behind it, is read.
template <class Message>
void expect_whole_messages_only(const Message& message) {
  Bytes bytes = written(message);
  ASSERT_LE(bytes.size(), kMaxMessage);
  Message got;
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_FALSE(read_message(std::span(bytes).first(size), got)) << size;
  }
  EXPECT_TRUE(read_message(bytes, got));
  bytes.push_back(std::byte{0});
  EXPECT_FALSE(read_message(bytes, got));
  for (int type = 0; type < 256; ++type) {
    Bytes other = written(message);
    const bool is_its_own = other.front() == static_cast<std::byte>(type);
    other.front() = static_cast<std::byte>(type);
    EXPECT_EQ(read_message(other, got), is_its_own);
  }
}

// Returns the bytes of a struct that its visit leaves out: padding, and a forgotten field.
template <class Message>
std::size_t bytes_without_a_line() {
  std::size_t bytes = 0;
  for (const Bytes& field : fields_of(Message{})) {
    bytes += field.size();
  }
  return sizeof(Message) - bytes;
}

TEST(LineMessage, EveryFieldOfAStructHasALineInItsVisit) {
  if constexpr (sizeof(void*) != 8) {
    GTEST_SKIP() << "the padding is that of a machine of 64 bits";
  }
  EXPECT_EQ(bytes_without_a_line<Hello>(), 26U);
  EXPECT_EQ(bytes_without_a_line<AskTicks>(), 0U);
  EXPECT_EQ(bytes_without_a_line<AskImage>(), 3U);
  EXPECT_EQ(bytes_without_a_line<LineStop>(), 0U);
  EXPECT_EQ(bytes_without_a_line<Command>(),
            13U + sizeof(std::uintptr_t) + sizeof(Command::injection));
  const std::size_t of_scenes = sizeof(SceneRefusal) - sizeof(SceneRefusal::part);
  EXPECT_EQ(bytes_without_a_line<Answer>(), 38U + of_scenes);
}

TEST(LineMessage, EveryFieldOfEveryMessageArrives) {
  expect_the_round_trip<Hello>();
  expect_the_round_trip<RecordedTick>();
  expect_the_round_trip<Answer>();
  expect_the_round_trip<AskTicks>();
  expect_the_round_trip<AskImage>();
  expect_the_round_trip<Command>();
  expect_the_round_trip<LineStop>();
}

TEST(LineMessage, AnImagePartArrives) {
  const Bytes bytes(kImagePartBytes, std::byte{0x42});
  for (const std::size_t size : {std::size_t{0}, std::size_t{1}, kImagePartBytes}) {
    const ImagePart sent{
        .image = BoardImage::scene, .offset = 0x01020304, .bytes = std::span(bytes).first(size)};
    const Bytes line = written(sent);
    ImagePart got;
    ASSERT_TRUE(read_message(line, got));
    EXPECT_EQ(got.image, sent.image);
    EXPECT_EQ(got.offset, sent.offset);
    EXPECT_TRUE(std::ranges::equal(got.bytes, sent.bytes));
  }
  Bytes too_large = written(ImagePart{.bytes = bytes});
  too_large.push_back(std::byte{0});
  ImagePart got;
  EXPECT_FALSE(read_message(too_large, got));
  EXPECT_FALSE(read_message(std::span(too_large).first(5), got)) << "the offset is cut";
}

TEST(LineMessage, OnlyWholeMessagesOfTheirTypeAreRead) {
  hal::Random random(22);
  expect_whole_messages_only(changed_message<Hello>(random));
  expect_whole_messages_only(changed_message<RecordedTick>(random));
  expect_whole_messages_only(changed_message<Answer>(random));
  expect_whole_messages_only(changed_message<AskTicks>(random));
  expect_whole_messages_only(changed_message<AskImage>(random));
  expect_whole_messages_only(changed_message<Command>(random));
  expect_whole_messages_only(changed_message<LineStop>(random));
  expect_whole_messages_only(AskHello{});
  expect_whole_messages_only(Alive{});
  expect_whole_messages_only(Release{});
}

TEST(LineMessage, ANumberOutOfItsRangeIsRefused) {
  const auto reads = []<class Message>(const Message& message) {
    Message got;
    return read_message(written(message), got);
  };
  RecordedTick tick;
  EXPECT_TRUE(reads(tick));
  tick.joint_count = drivers::kMaxJoints + 1;
  EXPECT_FALSE(reads(tick));
  tick = {};
  tick.record.mode = static_cast<Mode>(kModeCount);
  EXPECT_FALSE(reads(tick));
  tick = {};
  tick.record.friction = static_cast<rendering::FrictionState>(3);
  EXPECT_FALSE(reads(tick));
  tick = {};
  tick.record.contact = static_cast<rendering::ContactKind>(4);
  EXPECT_FALSE(reads(tick));
  tick = {};
  tick.record.limited_source = static_cast<EnergySource>(kEnergySourceNames.size());
  EXPECT_FALSE(reads(tick));
  tick = {};
  tick.record.change.place.parameter = static_cast<Parameter>(6);
  EXPECT_FALSE(reads(tick)) << "no parameter has that number";

  for (const CommandKind kind :
       {CommandKind::scene, CommandKind::inject, static_cast<CommandKind>(6)}) {
    EXPECT_FALSE(reads(Command{.kind = kind}));
  }
  EXPECT_FALSE(reads(Command{.request = static_cast<Request>(6)}));
  EXPECT_TRUE(reads(Command{.ticket = kLargestTicket}));
  EXPECT_FALSE(reads(Command{.ticket = kLargestTicket + 1}));
  EXPECT_FALSE(reads(LineStop{.ticket = kLargestTicket + 1}));
  EXPECT_FALSE(reads(AskImage{.image = static_cast<BoardImage>(2)}));

  Answer answer;
  answer.scene_refusal.part.other_count = 9;
  answer.scene_refusal.part.listed = UncertifiedPart::kMostOthers;
  EXPECT_TRUE(reads(answer));
  answer.scene_refusal.part.listed = UncertifiedPart::kMostOthers + 1;
  EXPECT_FALSE(reads(answer));
  answer.scene_refusal.part = {.other_count = 1, .listed = 2};
  EXPECT_FALSE(reads(answer));
  EXPECT_FALSE(reads(Answer{.outcome = static_cast<Outcome>(6)}));
  EXPECT_FALSE(reads(Answer{.refusal = static_cast<ParameterRefusal>(11)}));

  Hello hello{.joints = drivers::kMaxJoints};
  EXPECT_TRUE(reads(hello));
  hello.joints = drivers::kMaxJoints + 1;
  EXPECT_FALSE(reads(hello));
  hello = {.board = line_name("bell\a")};
  EXPECT_FALSE(reads(hello)) << "a terminal would obey it";
  hello = {.board = line_name("board")};
  hello.board.back() = 'x';
  EXPECT_FALSE(reads(hello)) << "nothing follows a name";
}

TEST(LineMessage, TheVersionOfAHelloIsReadWhateverElseItHas) {
  Bytes bytes = written(Hello{.version = 77});
  bytes.resize(9);
  EXPECT_EQ(hello_version(bytes), 77);
  Hello got;
  EXPECT_FALSE(read_message(written(Hello{.version = kLineVersion + 1}), got));
  EXPECT_EQ(hello_version(written(AskHello{})), std::nullopt);
  EXPECT_EQ(hello_version(written(AskTicks{})), std::nullopt);
}

TEST(LineMessage, ANameIsCutToItsRoom) {
  EXPECT_EQ(text_of(line_name("mps2_an500")), "mps2_an500");
  EXPECT_EQ(text_of(line_name(std::string(30, 'x'))), std::string(24, 'x'));
  EXPECT_EQ(text_of(line_name("")), "");
}

TEST(LineMessage, EveryTypeBeginsAMessageAndNothingElseIsAType) {
  int types = 0;
  for (int i = 0; i < 256; ++i) {
    const std::array<std::byte, 1> message{static_cast<std::byte>(i)};
    if (const auto type = type_of(message)) {
      EXPECT_EQ(static_cast<int>(*type), i);
      EXPECT_TRUE(begins_message(message.front()));
      ++types;
    }
  }
  EXPECT_EQ(types, 11);
  EXPECT_EQ(type_of({}), std::nullopt);
}

TEST(LineMessage, AnyBytesAreReadOrRefusedAndWrittenAgainAsTheyWere) {
  hal::Random random(23);
  int taken = 0;
  for (int i = tactus::testing::share_of(20'000); i > 0; --i) {
    Bytes bytes = written(changed_message<Command>(random));
    bytes[random.below(static_cast<std::uint32_t>(bytes.size()))] =
        static_cast<std::byte>(random.below(256));
    Command got;
    if (read_message(bytes, got)) {
      ++taken;
      EXPECT_EQ(written(got), bytes);
    }
  }
  EXPECT_GT(taken, 0);
}

}  // namespace
}  // namespace tactus::firmware
