// The parameters whose values have names: the friction model and the contact method of an object.
// Commands and programs show the names; the wire and recordings hold the name's number, as the
// double of any other parameter.
//
// Any thread; no heap.
#pragma once

#include <cstdint>
#include <string_view>

#include "firmware/control/parameters.h"

namespace tactus::firmware {

// The value that stands for a name that is not there. No object allows it.
inline constexpr double kNoChoice = -1.0;

// Returns true if the values of the parameter have names.
constexpr bool has_choices(Parameter parameter) {
  return parameter == Parameter::friction_model || parameter == Parameter::contact;
}

// Returns how many names the parameter's values have; 0 for a parameter without names.
std::uint32_t choice_count(Parameter parameter);

// Returns the name of a value; empty if it has none.
std::string_view choice_name(Parameter parameter, double value);

// Returns the value of that name, or kNoChoice.
double choice_of(Parameter parameter, std::string_view name);

// Returns true if the value is one that the object allows.
constexpr bool allows(const ParameterValue& range, double value) {
  for (std::uint32_t i = 0; i < 32; ++i) {
    if (value == static_cast<double>(i)) {
      return (range.choices >> i & 1U) != 0;
    }
  }
  return false;
}

// Calls `take` with the name of each allowed value, in the order of their numbers.
template <class Take>
void for_each_choice(Parameter parameter, const ParameterValue& range, const Take& take) {
  for (std::uint32_t i = 0; i < choice_count(parameter); ++i) {
    if (allows(range, i)) {
      take(choice_name(parameter, i));
    }
  }
}

}  // namespace tactus::firmware
