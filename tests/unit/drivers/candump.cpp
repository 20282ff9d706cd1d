#include "tests/unit/drivers/candump.h"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <fstream>

#include "tests/support/paths.h"

namespace tactus::drivers {

namespace {

template <class Number>
Number number_of(std::string_view hex) {
  Number number{};
  const auto [end, error] = std::from_chars(hex.data(), hex.data() + hex.size(), number, 16);
  EXPECT_TRUE(error == std::errc{} && end == hex.data() + hex.size()) << hex;
  return number;
}

std::string hex_of(std::uint32_t value, int digits) {
  std::string text(16, '\0');
  const int size = std::snprintf(text.data(), text.size(), "%0*X", digits, value);
  text.resize(static_cast<std::size_t>(size));
  return text;
}

}  // namespace

std::string text_of(const hal::CanFrame& frame) {
  std::string text = hex_of(frame.id, frame.extended ? 8 : 3) + '#';
  if (frame.remote) {
    return text + 'R';
  }
  if (frame.fd) {
    text += '#' + hex_of(frame.bit_rate_switch ? 1 : 0, 1);
  }
  for (const std::byte byte : frame.bytes()) {
    text += hex_of(std::to_integer<std::uint32_t>(byte), 2);
  }
  return text;
}

std::string candump_line(const hal::CanReceived& received, hal::TimeNs start_ns) {
  const auto us = (received.time_ns - start_ns) / 1000;
  std::string time(32, '\0');
  const int size =
      std::snprintf(time.data(), time.size(), "(%lld.%06lld) can0 ",
                    static_cast<long long>(us / 1'000'000), static_cast<long long>(us % 1'000'000));
  time.resize(static_cast<std::size_t>(size));
  return time + text_of(received.frame);
}

std::vector<std::byte> bytes_of(std::string_view hex) {
  std::string digits(hex);
  std::erase(digits, ' ');
  std::vector<std::byte> bytes;
  for (std::size_t i = 0; i + 1 < digits.size(); i += 2) {
    bytes.push_back(std::byte{number_of<std::uint8_t>(std::string_view(digits).substr(i, 2))});
  }
  return bytes;
}

hal::CanFrame frame_of(std::string_view text) {
  std::string compact(text);
  std::erase(compact, ' ');
  const std::size_t mark = compact.find('#');
  const std::string id = compact.substr(0, mark);
  std::string rest = compact.substr(mark + 1);
  hal::CanFrame frame{.id = number_of<std::uint32_t>(id), .extended = id.size() > 3};
  if (rest == "R") {
    frame.remote = true;
    return frame;
  }
  if (rest.starts_with('#')) {
    frame.fd = true;
    frame.bit_rate_switch = rest[1] == '1';
    rest = rest.substr(2);
  }
  const std::vector<std::byte> bytes = bytes_of(rest);
  frame.length = static_cast<std::uint8_t>(bytes.size());
  std::ranges::copy(bytes, frame.data.begin());
  return frame;
}

::testing::AssertionResult is_golden(const std::string& name, std::span<const std::string> lines) {
  const std::string path =
      tactus::testing::in_repository("tests/unit/drivers/golden/" + name + ".log");
  if (std::getenv("TACTUS_RENEW_GOLDEN") != nullptr) {
    std::ofstream file(path);
    for (const std::string& line : lines) {
      file << line << '\n';
    }
    return ::testing::AssertionSuccess();
  }
  std::ifstream file(path);
  std::string golden;
  std::size_t at = 0;
  while (std::getline(file, golden)) {
    if (at >= lines.size() || lines[at] != golden) {
      return ::testing::AssertionFailure()
             << path << ":" << at + 1 << ": expected '" << golden << "', got '"
             << (at < lines.size() ? lines[at] : "the end")
             << "'; TACTUS_RENEW_GOLDEN=1 writes the file anew";
    }
    ++at;
  }
  if (at != lines.size()) {
    return ::testing::AssertionFailure()
           << path << ": " << lines.size() - at << " lines more than in the file";
  }
  return ::testing::AssertionSuccess();
}

}  // namespace tactus::drivers
