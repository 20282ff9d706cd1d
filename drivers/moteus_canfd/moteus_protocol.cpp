#include "drivers/moteus_canfd/moteus_protocol.h"

#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

#include "drivers/common/little_endian.h"

namespace tactus::drivers::moteus {

namespace {

constexpr double kRadPerRev = 2.0 * std::numbers::pi;

constexpr std::uint32_t kWrite = 0x00;
constexpr std::uint32_t kRead = 0x10;
constexpr std::uint32_t kReply = 0x20;
constexpr std::uint32_t kWriteError = 0x30;
constexpr std::uint32_t kReadError = 0x31;
constexpr std::uint32_t kNothing = 0x50;

std::size_t size_of(ValueType type) {
  constexpr std::array<std::size_t, 4> kSizes{1, 2, 4, 4};
  return kSizes[static_cast<std::size_t>(type)];
}

// Writes subframes into a frame, one behind the other. All of them are known to fit.
class SubframeWriter {
 public:
  explicit SubframeWriter(hal::CanFrame& frame) : frame_(&frame) {}

  void header(std::uint32_t kind, ValueType type, std::uint32_t count, Register first) {
    put(static_cast<std::uint8_t>(kind + 4U * static_cast<std::uint32_t>(type) + count));
    put(static_cast<std::uint8_t>(first));  // one byte: every register here is below 0x80
  }
  template <class T>
  void put(T value) {
    store_little_endian(value, frame_->data, size_);
    size_ += sizeof value;
  }
  void close() {
    frame_->length = hal::padded_fd_length(size_);
    while (size_ < frame_->length) {
      put(static_cast<std::uint8_t>(kNothing));
    }
  }

 private:
  hal::CanFrame* frame_;
  std::size_t size_ = 0;
};

hal::CanFrame moteus_frame(const Address& address, bool wants_reply) {
  const std::uint32_t id = command_id(address, wants_reply);
  return {.id = id,
          .extended = id >= hal::kMaxStandardId,
          .fd = true,
          .bit_rate_switch = address.bit_rate_switch};
}

// Asks for the mode; for position, velocity and torque as floats; and for home state, voltage,
// temperature and fault.
void put_query(SubframeWriter& writer) {
  writer.header(kRead, ValueType::int8, 1, Register::mode);
  writer.header(kRead, ValueType::float32, 3, Register::position);
  writer.put(static_cast<std::uint8_t>(kRead));  // int8, the count in a byte of its own
  writer.put(std::uint8_t{4});
  writer.put(static_cast<std::uint8_t>(Register::home_state));
}

// Decodes a payload. After invalid bytes it returns nothing more.
class SubframeReader {
 public:
  explicit SubframeReader(std::span<const std::byte> rest) : rest_(rest) {}

  [[nodiscard]] bool empty() const { return rest_.empty(); }
  void give_up() { rest_ = {}; }

  std::optional<std::uint32_t> varuint() {
    constexpr std::size_t kMaxBytes = 5;
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < kMaxBytes && i < rest_.size(); ++i) {
      const auto byte = std::to_integer<std::uint64_t>(rest_[i]);
      value |= (byte & 0x7FU) << (7U * i);
      if ((byte & 0x80U) == 0) {
        rest_ = rest_.subspan(i + 1);
        return static_cast<std::uint32_t>(value);
      }
    }
    give_up();
    return std::nullopt;
  }

  // A value: an integer in `raw`, a float in `number`.
  struct Value {
    ValueType type = ValueType::int8;
    std::int32_t raw = 0;
    double number = 0.0;
  };
  std::optional<Value> value(ValueType type) {
    const std::size_t size = size_of(type);
    if (size > rest_.size()) {
      give_up();
      return std::nullopt;
    }
    Value value{.type = type};
    switch (type) {
      case ValueType::int8:
        // NOLINTNEXTLINE(bugprone-signed-char-misuse): a number, not a character
        value.raw = load_little_endian<std::int8_t>(rest_, 0);
        break;
      case ValueType::int16:
        value.raw = load_little_endian<std::int16_t>(rest_, 0);
        break;
      case ValueType::int32:
        value.raw = load_little_endian<std::int32_t>(rest_, 0);
        break;
      case ValueType::float32:
        value.number = static_cast<double>(load_little_endian<float>(rest_, 0));
        break;
    }
    rest_ = rest_.subspan(size);
    return value;
  }

 private:
  std::span<const std::byte> rest_;
};

double number_of(const SubframeReader::Value& value, Quantity quantity) {
  return value.type == ValueType::float32 ? value.number : scaled(value.raw, value.type, quantity);
}

// Returns a mode or a fault. 255, which is neither, stands for a value that does not fit into a
// byte.
std::uint8_t code_of(const SubframeReader::Value& value) {
  constexpr double kNone = 255.0;
  const double number = number_of(value, Quantity::plain);
  return static_cast<std::uint8_t>(number >= 0.0 && number < kNone ? number : kNone);
}

void note(std::uint32_t at, const SubframeReader::Value& value, Reply& reply) {
  switch (static_cast<Register>(at)) {
    case Register::mode:
      reply.mode = code_of(value);
      break;
    case Register::position:
      reply.position_rad = kRadPerRev * number_of(value, Quantity::position_rev);
      break;
    case Register::velocity:
      reply.velocity_rad_per_s = kRadPerRev * number_of(value, Quantity::velocity_rev_per_s);
      break;
    case Register::torque:
      reply.torque_Nm = number_of(value, Quantity::torque_Nm);
      break;
    case Register::voltage:
      reply.voltage_V = number_of(value, Quantity::voltage_V);
      break;
    case Register::temperature:
      reply.temperature_C = number_of(value, Quantity::temperature_C);
      break;
    case Register::home_state:
      reply.home_state = code_of(value);
      break;
    case Register::fault:
      reply.fault = code_of(value);
      break;
    default:
      break;
  }
}

void read_values(SubframeReader& reader, std::uint32_t header, Reply& reply) {
  const auto type = static_cast<ValueType>((header >> 2U) & 3U);
  const std::uint32_t short_count = header & 3U;
  const auto count = short_count != 0 ? std::optional(short_count) : reader.varuint();
  const auto first = reader.varuint();
  if (!count || !first) {
    return;
  }
  for (std::uint32_t i = 0; i < *count; ++i) {
    const auto value = reader.value(type);
    if (!value) {
      return;
    }
    const std::uint64_t at = std::uint64_t{*first} + i;
    if (at <= std::numeric_limits<std::uint16_t>::max()) {
      note(static_cast<std::uint32_t>(at), *value, reply);
    }
  }
}

}  // namespace

std::uint32_t command_id(const Address& address, bool wants_reply) {
  constexpr std::uint32_t kWantsReply = 0x8000;
  return (std::uint32_t{address.prefix} << 16U) | (wants_reply ? kWantsReply : 0U) |
         (std::uint32_t{address.host} << 8U) | address.servo;
}

std::uint32_t reply_id(const Address& address) {
  return (std::uint32_t{address.prefix} << 16U) | (std::uint32_t{address.servo} << 8U) |
         address.host;
}

hal::CanFrame stop(const Address& address, bool wants_reply) {
  hal::CanFrame frame = moteus_frame(address, wants_reply);
  SubframeWriter writer(frame);
  writer.header(kWrite, ValueType::int8, 1, Register::mode);
  writer.put(Mode::stopped);
  if (wants_reply) {
    put_query(writer);
  }
  writer.close();
  return frame;
}

// The mode comes first: writing it resets the whole command.
hal::CanFrame torque(const Address& address, float torque_Nm, float watchdog_s, bool wants_reply) {
  hal::CanFrame frame = moteus_frame(address, wants_reply);
  SubframeWriter writer(frame);
  writer.header(kWrite, ValueType::int8, 1, Register::mode);
  writer.put(Mode::position);
  writer.header(kWrite, ValueType::float32, 3, Register::command_position);
  writer.put(std::numeric_limits<float>::quiet_NaN());  // any position
  writer.put(0.0F);
  writer.put(torque_Nm);
  writer.header(kWrite, ValueType::float32, 2, Register::kp_scale);
  writer.put(0.0F);
  writer.put(0.0F);
  writer.header(kWrite, ValueType::float32, 1, Register::watchdog);
  writer.put(watchdog_s);
  writer.header(kWrite, ValueType::float32, 1, Register::integral_scale);
  writer.put(0.0F);
  if (wants_reply) {
    put_query(writer);
  }
  writer.close();
  return frame;
}

hal::CanFrame query(const Address& address) {
  hal::CanFrame frame = moteus_frame(address, true);
  SubframeWriter writer(frame);
  put_query(writer);
  writer.close();
  return frame;
}

Reply read_reply(std::span<const std::byte> payload) {
  Reply reply;
  SubframeReader reader(payload);
  while (!reader.empty()) {
    const auto header = reader.varuint();
    if (!header) {
      break;
    }
    if (*header >= kReply && *header < kReply + 0x10) {
      read_values(reader, *header, reply);
    } else if (*header == kWriteError || *header == kReadError) {
      reply.refused_register = reader.varuint();
      (void)reader.varuint();  // the number of the error
    } else if (*header != kNothing) {
      reader.give_up();
    }
  }
  return reply;
}

double scaled(std::int32_t raw, ValueType type, Quantity quantity) {
  struct Steps {
    double int8;
    double int16;
    double int32;
  };
  constexpr std::array<Steps, 9> kSteps = {{{1.0, 1.0, 1.0},
                                            {0.01, 0.0001, 0.00001},
                                            {0.1, 0.00025, 0.00001},
                                            {0.5, 0.01, 0.001},
                                            {1.0, 0.1, 0.001},
                                            {0.5, 0.1, 0.001},
                                            {1.0, 0.1, 0.001},
                                            {0.01, 0.001, 1e-6},
                                            {1.0 / 127.0, 1.0 / 32767.0, 1.0 / 2147483647.0}}};
  constexpr std::array<std::int32_t, 3> kNotANumber = {std::numeric_limits<std::int8_t>::min(),
                                                       std::numeric_limits<std::int16_t>::min(),
                                                       std::numeric_limits<std::int32_t>::min()};
  if (type == ValueType::float32) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  const auto width = static_cast<std::size_t>(type);
  if (quantity != Quantity::plain && raw == kNotANumber[width]) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  const Steps& steps = kSteps[static_cast<std::size_t>(quantity)];
  return raw * std::array{steps.int8, steps.int16, steps.int32}[width];
}

}  // namespace tactus::drivers::moteus
