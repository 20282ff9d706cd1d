// Settings of a device as a person wrote them, and tables that bind their keys to the fields of a
// struct. One table serves the controller, the check at baking and the advice on a wrong key.
#pragma once

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>

#include "drivers/common/field_error.h"
#include "drivers/common/must_be.h"

namespace tactus::drivers {

enum class SettingType : std::uint8_t { number, numbers, flag, text };

// One setting. Its texts and numbers are views into the image.
struct Setting {
  std::string_view key;
  SettingType type = SettingType::number;
  std::span<const double> numbers;  // one for a number; 0 or 1 for a flag
  std::string_view text;
};

// A word of an enumeration as a file has it. A function beside each bound enumeration lists them:
//   constexpr auto setting_words(E) { return std::to_array<Word<E>>({{"a", E::a}, {"b", E::b}}); }
template <class E>
using Word = std::pair<std::string_view, E>;

namespace detail {

template <class E>
inline constexpr auto kWords = setting_words(E{});

template <class E>
inline constexpr MustBe kWordRule{[] {
  std::array<std::string_view, kWords<E>.size()> words;
  for (std::size_t i = 0; i < words.size(); ++i) {
    words[i] = kWords<E>[i].first;
  }
  return words;
}()};

}  // namespace detail

// These assign a setting to a field. They return the error of the value, or an empty text. A type
// of a driver's own has its `assign` beside it, in this namespace.
inline std::string_view assign(double& field, const Setting& setting) {
  if (setting.type != SettingType::number) {
    return "must be a number";
  }
  field = setting.numbers[0];
  return {};
}

inline std::string_view assign(bool& field, const Setting& setting) {
  if (setting.type != SettingType::flag) {
    return "must be true or false";
  }
  field = setting.numbers[0] != 0.0;
  return {};
}

template <std::integral I>
  requires(!std::same_as<I, bool>)
std::string_view assign(I& field, const Setting& setting) {
  if (setting.type != SettingType::number || std::trunc(setting.numbers[0]) != setting.numbers[0]) {
    return "must be a whole number";
  }
  const double value = setting.numbers[0];
  if (value < static_cast<double>(std::numeric_limits<I>::lowest()) || std::abs(value) > 0x1p53 ||
      value > static_cast<double>(std::numeric_limits<I>::max())) {
    return "is out of range";
  }
  field = static_cast<I>(value);
  return {};
}

inline std::string_view assign(std::array<double, 3>& field, const Setting& setting) {
  if (setting.type != SettingType::numbers || setting.numbers.size() != 3) {
    return "must be three numbers";
  }
  field = {setting.numbers[0], setting.numbers[1], setting.numbers[2]};
  return {};
}

inline std::string_view assign(std::string_view& field, const Setting& setting) {
  if (setting.type != SettingType::text) {
    return "must be text, in quotes";
  }
  field = setting.text;
  return {};
}

template <class E>
  requires std::is_enum_v<E>
std::string_view assign(E& field, const Setting& setting) {
  if (setting.type == SettingType::text) {
    for (const auto& [word, value] : detail::kWords<E>) {
      if (word == setting.text) {
        field = value;
        return {};
      }
    }
  }
  return detail::kWordRule<E>.view();
}

template <class T>
std::string_view assign(std::optional<T>& field, const Setting& setting) {
  T value{};
  const std::string_view wrong = assign(value, setting);
  if (wrong.empty()) {
    field = value;
  }
  return wrong;
}

// The range of a number, ends included, and the words of its refusal: "must lie between 0 and 1".
struct Range {
  double low = 0.0;
  double high = 0.0;
  std::string_view rule;  // empty: the number has no range of its own
};

// A key, and the field of an S that it sets.
template <class S>
struct Binding {
  std::string_view key;
  std::string_view unit;  // the suffix of the key that names it; empty without one
  // Assigns a setting to the field. Returns the error of the value, or an empty text.
  std::string_view (*assign)(S& object, const Setting& setting);
  double (*value)(const S& object);  // the field as a number; 0 if it is none
  Range range;
};

namespace detail {

// The type of the struct to which a pointer to a member belongs.
template <class S, class T>
S struct_of(T S::*);

template <auto kFirst, auto... kRest, class S>
auto& field_of(S& object) {
  if constexpr (sizeof...(kRest) == 0) {
    return object.*kFirst;
  } else {
    return field_of<kRest...>(object.*kFirst);
  }
}

template <class T>
double as_number(const T& field) {
  if constexpr (std::is_arithmetic_v<T>) {
    return static_cast<double>(field);
  } else {
    return 0.0;
  }
}

}  // namespace detail

// Returns the binding of a member, or of a member's member: bind<&Joint::limits,
// &Limits::lower>(...).
template <auto kFirst, auto... kRest>
constexpr auto bind(std::string_view key, std::string_view unit = {}, const Range& range = {}) {
  using S = decltype(detail::struct_of(kFirst));
  return Binding<S>{.key = key,
                    .unit = unit,
                    .assign =
                        [](S& object, const Setting& setting) {
                          return assign(detail::field_of<kFirst, kRest...>(object), setting);
                        },
                    .value =
                        [](const S& object) {
                          return detail::as_number(detail::field_of<kFirst, kRest...>(object));
                        },
                    .range = range};
}

// Checks every number that has a range. The error names the key.
template <class S>
Checked check_ranges(const S& object, std::span<const Binding<S>> keys) {
  for (const Binding<S>& binding : keys) {
    const Range& range = binding.range;
    if (!range.rule.empty() && !lies_between(binding.value(object), range.low, range.high)) {
      return std::unexpected(FieldError{binding.key, range.rule});
    }
  }
  return {};
}

}  // namespace tactus::drivers
