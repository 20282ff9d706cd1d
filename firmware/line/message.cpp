#include "firmware/line/message.h"

#include <algorithm>
#include <limits>
#include <type_traits>

#include "drivers/common/little_endian.h"
#include "firmware/line/message_fields.h"
#include "firmware/telemetry/record_fields.h"

namespace tactus::firmware {
namespace {

// Returns true if the enumeration has that value.
constexpr bool has_value(Mode mode) {
  return static_cast<std::size_t>(mode) < kModeCount;
}
constexpr bool has_value(Request request) {
  return static_cast<std::size_t>(request) < kRequestNames.size();
}
constexpr bool has_value(Parameter parameter) {
  return parameter == Parameter::none || text_of(parameter) != nullptr;
}
constexpr bool has_value(rendering::ContactKind kind) {
  return kind <= rendering::ContactKind::vertex;
}
constexpr bool has_value(rendering::FrictionState state) {
  return state <= rendering::FrictionState::slip;
}
constexpr bool has_value(EnergySource source) {
  return static_cast<std::size_t>(source) < kEnergySourceNames.size();
}
constexpr bool has_value(CommandKind kind) {
  return kind <= CommandKind::inject;
}
constexpr bool has_value(Outcome outcome) {
  return outcome <= Outcome::scene;
}
constexpr bool has_value(ParameterRefusal refusal) {
  return refusal <= ParameterRefusal::uncertified;
}
constexpr bool has_value(UncertifiedPart::Kind kind) {
  return kind <= UncertifiedPart::Kind::wall;
}
constexpr bool has_value(BoardImage image) {
  return image <= BoardImage::scene;
}

// Writes fields one after the other.
class FieldWriter {
 public:
  FieldWriter(MessageType type, std::span<std::byte> room) : room_(room) { number(type); }

  template <class Number>
    requires(std::is_arithmetic_v<Number> || std::is_enum_v<Number>)
  void operator()(const Number& value) {
    number(value);
  }
  template <class Number, std::size_t kCount>
  void operator()(const std::array<Number, kCount>& values) {
    for (const Number& value : values) {
      number(value);
    }
  }
  void operator()(const LineSize<const std::size_t>& size) {
    number(static_cast<std::uint32_t>(
        std::min<std::size_t>(size.number, std::numeric_limits<std::uint32_t>::max())));
  }
  template <class Field>
  void operator()(const FieldName& /*name*/, const Field& field) {
    (*this)(field);
  }
  void bytes(std::span<const std::byte> bytes) {
    std::ranges::copy(bytes, room_.begin() + static_cast<std::ptrdiff_t>(size_));
    size_ += bytes.size();
  }

  [[nodiscard]] std::span<const std::byte> message() const { return room_.first(size_); }

 private:
  template <class Number>
  void number(Number value) {
    drivers::store_little_endian(value, room_, size_);
    size_ += sizeof(value);
  }

  std::span<std::byte> room_;
  std::size_t size_ = 0;
};

// Reads fields one after the other. After a field that is not there, or that is out of its range,
// all reading fails.
class FieldReader {
 public:
  FieldReader(MessageType type, std::span<const std::byte> message) : rest_(message) {
    std::uint8_t first = 0;
    number(first);
    is_right_ = is_right_ && first == static_cast<std::uint8_t>(type);
  }

  template <class Number>
    requires(std::is_arithmetic_v<Number> || std::is_enum_v<Number>)
  void operator()(Number& value) {
    number(value);
  }
  template <class Number, std::size_t kCount>
  void operator()(std::array<Number, kCount>& values) {
    for (Number& value : values) {
      number(value);
    }
  }
  void operator()(const LineSize<std::size_t>& size) {
    std::uint32_t value = 0;
    number(value);
    size.number = value;
  }
  template <class Field>
  void operator()(const FieldName& /*name*/, Field& field) {
    (*this)(field);
  }
  // Returns the bytes that are left, and takes them.
  std::span<const std::byte> bytes() { return std::exchange(rest_, {}); }

  // Returns true if all fields were there and nothing is left.
  [[nodiscard]] bool is_whole() const { return is_right_ && rest_.empty(); }

 private:
  template <class Number>
  void number(Number& value) {
    if (!is_right_ || rest_.size() < sizeof(value)) {
      is_right_ = false;
      return;
    }
    const auto read = drivers::load_little_endian<Number>(rest_, 0);
    rest_ = rest_.subspan(sizeof(value));
    if constexpr (std::is_enum_v<Number>) {
      if (!has_value(read)) {
        is_right_ = false;
        return;
      }
    }
    value = read;
  }

  std::span<const std::byte> rest_;
  bool is_right_ = true;
};

bool is_printable(const LineName& name) {
  const std::string_view text = text_of(name);
  return std::ranges::all_of(text, [](char c) { return c >= ' ' && c <= '~'; }) &&
         std::all_of(name.begin() + static_cast<std::ptrdiff_t>(text.size()), name.end(),
                     [](char c) { return c == '\0'; });
}

// Reads a message without fields.
bool is_bare(MessageType type, std::span<const std::byte> message) {
  return message.size() == 1 && type_of(message) == type;
}

std::span<const std::byte> write_bare(MessageType type, std::span<std::byte> room) {
  return FieldWriter(type, room).message();
}

}  // namespace

LineName line_name(std::string_view name) {
  LineName result{};
  std::copy_n(name.begin(), std::min(name.size(), result.size()), result.begin());
  return result;
}

std::string_view text_of(const LineName& name) {
  const auto end = std::ranges::find(name, '\0');
  return {name.data(), static_cast<std::size_t>(end - name.begin())};
}

std::optional<MessageType> type_of(std::span<const std::byte> message) {
  if (message.empty()) {
    return std::nullopt;
  }
  const auto type = static_cast<MessageType>(message.front());
  const bool is_of_board = type >= MessageType::hello && type <= MessageType::image_part;
  const bool is_of_host = type >= MessageType::ask_hello && type <= MessageType::release;
  return is_of_board || is_of_host ? std::optional(type) : std::nullopt;
}

std::optional<std::uint8_t> hello_version(std::span<const std::byte> message) {
  if (message.size() < 2 || type_of(message) != MessageType::hello) {
    return std::nullopt;
  }
  return std::to_integer<std::uint8_t>(message[1]);
}

std::span<const std::byte> write_message(const Hello& hello, std::span<std::byte> room) {
  FieldWriter writer(MessageType::hello, room);
  visit_hello_fields(hello, writer);
  return writer.message();
}

std::span<const std::byte> write_message(const RecordedTick& tick, std::span<std::byte> room) {
  FieldWriter writer(MessageType::tick, room);
  visit_tick_fields(tick, writer);
  return writer.message();
}

std::span<const std::byte> write_message(const Answer& answer, std::span<std::byte> room) {
  FieldWriter writer(MessageType::answer, room);
  visit_answer_fields(answer, writer);
  return writer.message();
}

std::span<const std::byte> write_message(const ImagePart& part, std::span<std::byte> room) {
  FieldWriter writer(MessageType::image_part, room);
  writer(part.image);
  writer(part.offset);
  writer.bytes(part.bytes.first(std::min(part.bytes.size(), kImagePartBytes)));
  return writer.message();
}

std::span<const std::byte> write_message(const AskHello& /*ask*/, std::span<std::byte> room) {
  return write_bare(MessageType::ask_hello, room);
}

std::span<const std::byte> write_message(const AskTicks& ask, std::span<std::byte> room) {
  FieldWriter writer(MessageType::ask_ticks, room);
  visit_ask_ticks_fields(ask, writer);
  return writer.message();
}

std::span<const std::byte> write_message(const AskImage& ask, std::span<std::byte> room) {
  FieldWriter writer(MessageType::ask_image, room);
  visit_ask_image_fields(ask, writer);
  return writer.message();
}

std::span<const std::byte> write_message(const Command& command, std::span<std::byte> room) {
  FieldWriter writer(MessageType::command, room);
  visit_command_fields(command, writer);
  return writer.message();
}

std::span<const std::byte> write_message(const LineStop& stop, std::span<std::byte> room) {
  FieldWriter writer(MessageType::stop, room);
  visit_stop_fields(stop, writer);
  return writer.message();
}

std::span<const std::byte> write_message(const Alive& /*alive*/, std::span<std::byte> room) {
  return write_bare(MessageType::alive, room);
}

std::span<const std::byte> write_message(const Release& /*release*/, std::span<std::byte> room) {
  return write_bare(MessageType::release, room);
}

bool read_message(std::span<const std::byte> message, Hello& hello) {
  FieldReader reader(MessageType::hello, message);
  visit_hello_fields(hello, reader);
  return reader.is_whole() && hello.version == kLineVersion &&
         hello.joints <= drivers::kMaxJoints && is_printable(hello.board) &&
         is_printable(hello.profile);
}

bool read_message(std::span<const std::byte> message, RecordedTick& tick) {
  FieldReader reader(MessageType::tick, message);
  visit_tick_fields(tick, reader);
  return reader.is_whole() && tick.joint_count <= drivers::kMaxJoints;
}

bool read_message(std::span<const std::byte> message, Answer& answer) {
  FieldReader reader(MessageType::answer, message);
  visit_answer_fields(answer, reader);
  const UncertifiedPart& part = answer.scene_refusal.part;
  return reader.is_whole() && part.listed <= part.others.size() && part.listed <= part.other_count;
}

bool read_message(std::span<const std::byte> message, ImagePart& part) {
  FieldReader reader(MessageType::image_part, message);
  reader(part.image);
  reader(part.offset);
  part.bytes = reader.bytes();
  return reader.is_whole() && part.bytes.size() <= kImagePartBytes;
}

bool read_message(std::span<const std::byte> message, AskHello& /*ask*/) {
  return is_bare(MessageType::ask_hello, message);
}

bool read_message(std::span<const std::byte> message, AskTicks& ask) {
  FieldReader reader(MessageType::ask_ticks, message);
  visit_ask_ticks_fields(ask, reader);
  return reader.is_whole();
}

bool read_message(std::span<const std::byte> message, AskImage& ask) {
  FieldReader reader(MessageType::ask_image, message);
  visit_ask_image_fields(ask, reader);
  return reader.is_whole();
}

bool read_message(std::span<const std::byte> message, Command& command) {
  FieldReader reader(MessageType::command, message);
  visit_command_fields(command, reader);
  const bool is_carried = command.kind != CommandKind::scene && command.kind != CommandKind::inject;
  return reader.is_whole() && is_carried && command.ticket <= kLargestTicket;
}

bool read_message(std::span<const std::byte> message, LineStop& stop) {
  FieldReader reader(MessageType::stop, message);
  visit_stop_fields(stop, reader);
  return reader.is_whole() && stop.ticket <= kLargestTicket;
}

bool read_message(std::span<const std::byte> message, Alive& /*alive*/) {
  return is_bare(MessageType::alive, message);
}

bool read_message(std::span<const std::byte> message, Release& /*release*/) {
  return is_bare(MessageType::release, message);
}

}  // namespace tactus::firmware
