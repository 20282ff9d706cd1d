#include "drivers/cia402_can/sdo.h"

#include <algorithm>
#include <array>

#include "drivers/cia402_can/canopen.h"
#include "drivers/common/little_endian.h"

namespace tactus::drivers::canopen {

namespace {

// The first byte has the command specifier in bits 5..7. In expedited transfers the number of
// unused data bytes (of four) is in bits 2..3, 'expedited' in bit 1, and 'size indicated' in bit 0.
constexpr std::uint8_t kReadRequest = 0x40;
constexpr std::uint8_t kWriteRequest = 0x23;  // expedited, size indicated
constexpr std::uint8_t kWriteAnswer = 0x60;
constexpr std::uint8_t kAbort = 0x80;
constexpr std::uint8_t kSpecifier = 0xE0;
constexpr std::uint8_t kExpedited = 0x02;
constexpr std::uint8_t kSizeIndicated = 0x01;

hal::CanFrame sdo_request(std::uint8_t node, std::uint8_t command, ObjectAddress object,
                          std::uint32_t value) {
  hal::CanFrame frame{.id = kSdoRequest + node, .length = 8};
  frame.data[0] = static_cast<std::byte>(command);
  store_little_endian(object.index, frame.data, 1);
  frame.data[3] = static_cast<std::byte>(object.sub);
  store_little_endian(value, frame.data, 4);
  return frame;
}

std::uint32_t low_bytes(std::uint32_t value, std::uint8_t size) {
  return size >= 4 ? value : value & ((1U << (8U * size)) - 1U);
}

SdoAnswer read_answer(std::uint8_t command, SdoAnswer answer) {
  if ((command & kExpedited) == 0) {
    answer.kind = SdoAnswer::Kind::segmented;
    return answer;
  }
  answer.kind = SdoAnswer::Kind::value;
  answer.size = (command & kSizeIndicated) != 0
                    ? static_cast<std::uint8_t>(4U - (command >> 2U & 3U))
                    : std::uint8_t{4};
  answer.value = low_bytes(answer.value, answer.size);
  return answer;
}

struct AbortWords {
  std::uint32_t code = 0;
  std::string_view words;
};

constexpr std::array<AbortWords, 23> kAbortWords = {{
    {0x0503'0000, "toggle bit not alternated: look for a second master on the bus"},
    {0x0504'0000, "the drive's own time limit passed: try again, and look at the load of the bus"},
    {0x0504'0001, "command not known: the drive does not speak this part of CANopen"},
    {0x0601'0000, "access not supported: check the drive's type and firmware"},
    {0x0601'0001, "object is write-only: check the drive's type and firmware"},
    {0x0601'0002, "object is read-only: check the drive's type and firmware"},
    {0x0602'0000, "no such object: check the drive's type and firmware"},
    {0x0604'0041, "object cannot be mapped to a PDO: the drive cannot do this mapping"},
    {0x0604'0042, "mapping is too long: the drive cannot do this mapping"},
    {0x0604'0043, "parameters do not go together: restore the drive's defaults"},
    {0x0606'0000, "hardware error: see the drive's own diagnosis"},
    {0x0607'0010, "length does not match: check the drive's type and firmware"},
    {0x0607'0012, "value too long: check the drive's type and firmware"},
    {0x0607'0013, "value too short: check the drive's type and firmware"},
    {0x0609'0011, "no such sub-index: check the drive's type and firmware"},
    {0x0609'0030, "value out of range: correct the configuration"},
    {0x0609'0031, "value too high: correct the configuration"},
    {0x0609'0032, "value too low: correct the configuration"},
    {0x0800'0000, "general error: see the drive's own diagnosis"},
    {0x0800'0020, "data cannot be stored: see the drive's own diagnosis"},
    {0x0800'0021, "the drive is under local control: take it to remote control"},
    {0x0800'0022, "not in the drive's present state: reset, or switch it off and on"},
    {0x0800'0023, "no object dictionary: see the drive's own diagnosis"},
}};

}  // namespace

hal::CanFrame sdo_read(std::uint8_t node, ObjectAddress object) {
  return sdo_request(node, kReadRequest, object, 0);
}

hal::CanFrame sdo_write(std::uint8_t node, ObjectAddress object, std::uint32_t value,
                        std::uint8_t size) {
  const auto unused = static_cast<std::uint8_t>((4U - size) << 2U);
  return sdo_request(node, static_cast<std::uint8_t>(kWriteRequest | unused), object,
                     low_bytes(value, size));
}

hal::CanFrame sdo_abort(std::uint8_t node, ObjectAddress object, std::uint32_t code) {
  return sdo_request(node, kAbort, object, code);
}

std::optional<SdoAnswer> sdo_answer_of(const hal::CanFrame& frame, std::uint8_t node) {
  if (!is_from(frame, kSdoAnswer, node)) {
    return std::nullopt;
  }
  if (frame.length != 8) {
    return SdoAnswer{};
  }
  SdoAnswer answer{.object = {load_little_endian<std::uint16_t>(frame.data, 1),
                              std::to_integer<std::uint8_t>(frame.data[3])},
                   .value = load_little_endian<std::uint32_t>(frame.data, 4)};
  const auto command = std::to_integer<std::uint8_t>(frame.data[0]);
  switch (command & kSpecifier) {
    case kReadRequest:
      return read_answer(command, answer);
    case kWriteAnswer:
      answer.kind = SdoAnswer::Kind::written;
      return answer;
    case kAbort:
      answer.kind = SdoAnswer::Kind::abort;
      return answer;
    default:
      return answer;
  }
}

std::string_view sdo_abort_words(std::uint32_t code) {
  const auto* known = std::ranges::find(kAbortWords, code, &AbortWords::code);
  return known == kAbortWords.end() ? "see the abort code in the drive's manual" : known->words;
}

}  // namespace tactus::drivers::canopen
