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

#include "rendering/geometry/vector.h"

namespace tactus::firmware {

enum class SettingType : std::uint8_t { number, numbers, flag, text };

// One setting. Its texts and numbers are views into the image.
struct Setting {
  std::string_view key;
  SettingType type = SettingType::number;
  std::span<const double> numbers;  // one for a number; 0 or 1 for a flag
  std::string_view text;
};

// The words of an enumeration as a file has them. They are specialised for each bound enumeration:
//   template <> inline constexpr std::array kWords<E> = std::to_array<Word<E>>({{"a", E::a}});
//   template <> inline constexpr std::string_view kWordList<E> = "must be \"a\"";
template <class E>
using Word = std::pair<std::string_view, E>;
template <class E>
inline constexpr std::array<Word<E>, 0> kWords{};
template <class E>
inline constexpr std::string_view kWordList{};

namespace detail {

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

inline std::string_view assign(Vec3& field, const Setting& setting) {
  if (setting.type != SettingType::numbers || setting.numbers.size() != 3) {
    return "must be three numbers, [x, y, z]";
  }
  field = {setting.numbers[0], setting.numbers[1], setting.numbers[2]};
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
    for (const auto& [word, value] : kWords<E>) {
      if (word == setting.text) {
        field = value;
        return {};
      }
    }
  }
  return kWordList<E>;
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

}  // namespace detail

// Assigns a setting to a field. `assign` returns the error of the value, or an empty text.
template <class S>
struct Binding {
  std::string_view key;
  std::string_view unit;  // the suffix of the key that names it; empty without one
  std::string_view (*assign)(S& object, const Setting& setting);
};

// Returns the binding of a member, or of a member's member: bind<&Joint::limits,
// &Limits::lower>(...).
template <auto kFirst, auto... kRest>
constexpr auto bind(std::string_view key, std::string_view unit = {}) {
  using S = decltype(detail::struct_of(kFirst));
  return Binding<S>{key, unit, [](S& object, const Setting& setting) {
                      return detail::assign(detail::field_of<kFirst, kRest...>(object), setting);
                    }};
}

}  // namespace tactus::firmware
