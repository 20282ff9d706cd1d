#include "firmware/control/parameter_name.h"

#include <algorithm>
#include <charconv>
#include <limits>

namespace tactus::firmware {
namespace {

constexpr std::string_view kObjectPrefix = "object.";
// The size of a dot and the digits of the largest number.
constexpr std::size_t kMaxNumber = 1 + std::numeric_limits<std::uint32_t>::digits10 + 1;

static_assert(std::ranges::all_of(kParameterTexts, [](const ParameterText& text) {
  return kObjectPrefix.size() + kMaxNumber + text.name.size() <= kMaxParameterName;
}));

// Returns the row with that name; null if there is none of that kind.
const ParameterText* find_by_name(std::string_view name, bool of_object) {
  const auto* const found = std::ranges::find_if(kParameterTexts, [&](const ParameterText& text) {
    return text.name == name && is_of_object(text.parameter) == of_object;
  });
  return found == kParameterTexts.end() ? nullptr : found;
}

}  // namespace

std::optional<ParameterName> parse_parameter_name(std::string_view text) {
  ParameterName name;
  std::string_view rest = text;
  if (text.starts_with(kObjectPrefix)) {
    rest.remove_prefix(kObjectPrefix.size());
    // An object's name may hold dots itself; a parameter's does not.
    const std::size_t dot = rest.rfind('.');
    if (dot == std::string_view::npos || dot == 0) {
      return std::nullopt;
    }
    name.object = rest;
    name.object.remove_suffix(rest.size() - dot);
    rest.remove_prefix(dot + 1);
  }
  const ParameterText* const found = find_by_name(rest, !name.object.empty());
  if (found == nullptr) {
    return std::nullopt;
  }
  name.parameter = found->parameter;
  return name;
}

std::optional<std::uint32_t> object_number(std::string_view object) {
  std::uint32_t number = 0;
  const char* const end = object.data() + object.size();
  const auto [stopped, error] = std::from_chars(object.data(), end, number);
  if (object.empty() || error != std::errc{} || stopped != end) {
    return std::nullopt;
  }
  return number;
}

std::string_view write_parameter_name(const ParameterPlace& place,
                                      std::span<char, kMaxParameterName> room) {
  const ParameterText* const text = text_of(place.parameter);
  if (text == nullptr) {
    return {};
  }
  char* at = room.data();
  if (is_of_object(place.parameter)) {
    at = std::ranges::copy(kObjectPrefix, at).out;
    at = std::to_chars(at, room.data() + room.size(), place.object).ptr;
    *at++ = '.';
  }
  at = std::ranges::copy(text->name, at).out;
  return {room.data(), static_cast<std::size_t>(at - room.data())};
}

}  // namespace tactus::firmware
