// Reads the chunks of an animated PNG file by the specification, with a checksum of its own.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace tactus::testing {

struct PngChunk {
  std::string type;
  std::string content;
  bool is_sound = false;  // its checksum is right
};

// Returns the number in `count` bytes, the most significant one first.
inline std::uint32_t png_number(std::string_view bytes, std::size_t at, std::size_t count = 4) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < count; ++i) {
    value = value << 8U | static_cast<std::uint8_t>(bytes.at(at + i));
  }
  return value;
}

// Returns the checksum of PNG, bit by bit (ISO 3309).
inline std::uint32_t png_checksum(std::string_view bytes) {
  std::uint32_t rest = 0xffffffff;
  for (const char byte : bytes) {
    rest ^= static_cast<std::uint8_t>(byte);
    for (int bit = 0; bit < 8; ++bit) {
      rest = (rest & 1U) != 0 ? rest >> 1U ^ 0xedb88320U : rest >> 1U;
    }
  }
  return ~rest;
}

// Returns the file's chunks in their order; none if it does not begin as a PNG file.
inline std::vector<PngChunk> png_chunks(std::string_view file) {
  std::vector<PngChunk> chunks;
  if (!file.starts_with("\x89PNG\r\n\x1a\n")) {
    return chunks;
  }
  for (std::size_t at = 8; at < file.size();) {
    const std::size_t size = png_number(file, at);
    const std::string_view body = file.substr(at + 4, 4 + size);
    chunks.push_back({.type = std::string(body.substr(0, 4)),
                      .content = std::string(body.substr(4)),
                      .is_sound = png_checksum(body) == png_number(file, at + 8 + size)});
    at += size + 12;
  }
  return chunks;
}

}  // namespace tactus::testing
