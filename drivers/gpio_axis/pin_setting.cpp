#include "drivers/gpio_axis/pin_setting.h"

#include <algorithm>
#include <charconv>
#include <cstdint>

namespace tactus::drivers {
namespace {

constexpr std::string_view kPinRule =
    "must be a line's number in quotes, with the words active_low, pull_up, pull_down as needed";

std::string_view next_word(std::string_view& rest) {
  rest.remove_prefix(std::min(rest.find_first_not_of(' '), rest.size()));
  const std::string_view word = rest.substr(0, rest.find(' '));
  rest.remove_prefix(word.size());
  return word;
}

bool read_line_number(std::string_view word, std::uint32_t& number) {
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  return error == std::errc{} && end == word.data() + word.size();
}

// Reads the line's number, then gives every word to `take`, which returns true if it knows the
// word.
template <class Pin, class TakeWord>
std::string_view read_pin(Pin& pin, const Setting& setting, std::string_view unknown_word,
                          TakeWord take) {
  std::string_view rest = setting.text;
  if (setting.type != SettingType::text || !read_line_number(next_word(rest), pin.offset)) {
    return kPinRule;
  }
  for (std::string_view word = next_word(rest); !word.empty(); word = next_word(rest)) {
    if (word == "active_low") {
      pin.active_low = true;
    } else if (!take(word)) {
      return unknown_word;
    }
  }
  return {};
}

}  // namespace

std::string_view assign(InputPin& pin, const Setting& setting) {
  return read_pin(pin, setting, kPinRule, [&](std::string_view word) {
    if (word == "pull_up") {
      pin.bias = hal::GpioBias::pull_up;
    } else if (word == "pull_down") {
      pin.bias = hal::GpioBias::pull_down;
    } else {
      return false;
    }
    return true;
  });
}

std::string_view assign(OutputPin& pin, const Setting& setting) {
  constexpr std::string_view kUnknownWord =
      "must be a line's number in quotes, with the words active_low, open_drain as needed";
  return read_pin(pin, setting, kUnknownWord, [&](std::string_view word) {
    if (word != "open_drain") {
      return false;
    }
    pin.drive = hal::GpioDrive::open_drain;
    return true;
  });
}

}  // namespace tactus::drivers
