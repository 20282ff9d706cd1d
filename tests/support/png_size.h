// The size of a picture, to see that a file is one.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

namespace tactus::testing {

struct PngSize {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
};

// Reads the size from the header that every PNG file begins with; zero for any other file.
inline PngSize png_size(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string head(24, '\0');
  stream.read(head.data(), static_cast<std::streamsize>(head.size()));
  if (head.substr(1, 3) != "PNG") {
    return {};
  }
  const auto word = [&head](std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      value = value << 8U | static_cast<std::uint8_t>(head[at + i]);
    }
    return value;
  };
  return {.width = word(16), .height = word(20)};
}

}  // namespace tactus::testing
