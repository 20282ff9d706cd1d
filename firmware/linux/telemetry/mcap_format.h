// The parts of the MCAP format (https://mcap.dev/spec) that writer and reader share. All numbers
// are little endian. No heap; one thread for each object.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>

namespace tactus::firmware::mcap {

// The first and the last bytes of a file.
inline constexpr std::string_view kMagic{"\x89MCAP0\r\n", 8};

// The kinds of records.
enum class Opcode : std::uint8_t {
  none = 0x00,  // no record has it
  header = 0x01,
  footer = 0x02,
  schema = 0x03,
  channel = 0x04,
  message = 0x05,
  chunk = 0x06,
  message_index = 0x07,
  chunk_index = 0x08,
  attachment = 0x09,
  attachment_index = 0x0A,
  statistics = 0x0B,
  metadata = 0x0C,
  metadata_index = 0x0D,
  summary_offset = 0x0E,
  data_end = 0x0F
};

// The size of a record's header: its opcode and the length of its content.
inline constexpr std::size_t kRecordHeaderBytes = 1 + 8;
// The size of an uncompressed chunk's header, before its records: first and last time, size,
// checksum, empty name of the compression, size of the records.
inline constexpr std::size_t kChunkHeaderBytes = 8 + 8 + 8 + 4 + 4 + 8;
// The size of a message's header: channel, sequence number, log time, publish time.
inline constexpr std::size_t kMessageHeaderBytes = 2 + 4 + 8 + 8;

// Writes values into a buffer one after the other. A value that does not fit is left out, and
// `overflowed` then returns true.
class Packer {
 public:
  explicit Packer(std::span<std::byte> room) : room_(room) {}

  // Adds bytes as they are.
  Packer& bytes(std::span<const std::byte> bytes) {
    if (bytes.size() > room_.size() - size_) {
      overflowed_ = true;
    } else if (!bytes.empty()) {
      std::memcpy(room_.data() + size_, bytes.data(), bytes.size());
      size_ += bytes.size();
    }
    return *this;
  }
  template <class Number>
  // Adds a number, the lowest byte first.
  Packer& number(Number value) {
    std::array<std::byte, sizeof(Number)> stored;
    for (std::size_t i = 0; i < stored.size(); ++i) {
      stored[i] = static_cast<std::byte>(static_cast<std::uint64_t>(value) >> (8 * i));
    }
    return bytes(stored);
  }
  // Add numbers of 1, 2, 4 and 8 bytes.
  Packer& u8(std::uint8_t value) { return number(value); }
  Packer& u16(std::uint16_t value) { return number(value); }
  Packer& u32(std::uint32_t value) { return number(value); }
  Packer& u64(std::uint64_t value) { return number(value); }
  // Adds a text after its length.
  Packer& text(std::string_view text) {
    return u32(static_cast<std::uint32_t>(text.size())).bytes(std::as_bytes(std::span(text)));
  }
  // Adds the header of a record whose content has that many bytes.
  Packer& record(Opcode opcode, std::uint64_t content_bytes) {
    return u8(static_cast<std::uint8_t>(opcode)).u64(content_bytes);
  }

  // Returns the bytes written so far.
  [[nodiscard]] std::span<const std::byte> packed() const { return room_.first(size_); }
  // Returns the number of bytes written so far.
  [[nodiscard]] std::size_t size() const { return size_; }
  // Returns true if a value did not fit.
  [[nodiscard]] bool overflowed() const { return overflowed_; }

 private:
  std::span<std::byte> room_;
  std::size_t size_ = 0;
  bool overflowed_ = false;
};

// Reads values from a buffer one after the other. Beyond the end it returns zeros and empty views,
// and `failed` then returns true.
class Unpacker {
 public:
  explicit Unpacker(std::span<const std::byte> bytes) : bytes_(bytes) {}

  // Returns the next bytes as a view.
  std::span<const std::byte> bytes(std::uint64_t count) {
    if (count > bytes_.size()) {
      failed_ = true;
      bytes_ = {};
      return {};
    }
    const auto taken = bytes_.first(static_cast<std::size_t>(count));
    bytes_ = bytes_.subspan(taken.size());
    return taken;
  }
  template <class Number>
  // Returns the next number.
  Number number() {
    std::uint64_t value = 0;
    const auto stored = bytes(sizeof(Number));
    for (std::size_t i = 0; i < stored.size(); ++i) {
      value |= std::to_integer<std::uint64_t>(stored[i]) << (8 * i);
    }
    return static_cast<Number>(value);
  }
  // Return the next numbers of 1, 2, 4 and 8 bytes.
  std::uint8_t u8() { return number<std::uint8_t>(); }
  std::uint16_t u16() { return number<std::uint16_t>(); }
  std::uint32_t u32() { return number<std::uint32_t>(); }
  std::uint64_t u64() { return number<std::uint64_t>(); }
  // Returns the next text as a view.
  std::string_view text() {
    const auto stored = bytes(u32());
    // The cast is allowed because char may alias any type.
    return {reinterpret_cast<const char*>(stored.data()), stored.size()};
  }

  // Returns all bytes that were not read yet.
  [[nodiscard]] std::span<const std::byte> rest() const { return bytes_; }
  // Returns true if something was read beyond the end.
  [[nodiscard]] bool failed() const { return failed_; }

 private:
  std::span<const std::byte> bytes_;
  bool failed_ = false;
};

}  // namespace tactus::firmware::mcap
