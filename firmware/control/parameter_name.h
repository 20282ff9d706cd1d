// Parses and writes the names of parameters: "max_force_N", and for an object
// "object.3.stiffness_N_per_m" or, if the scene's names are known,
// "object.bunny.stiffness_N_per_m".
//
// Any thread; no heap.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "firmware/control/parameters.h"

namespace tactus::firmware {

// The parts of a written name, as views into it.
struct ParameterName {
  Parameter parameter = Parameter::none;
  std::string_view object;  // the part between the dots; empty for the controller's own
};

// Returns the parts of a name, or nothing if there is no such parameter. It does not check whether
// the object exists.
std::optional<ParameterName> parse_parameter_name(std::string_view text);

// Returns the number of an object written in digits, or nothing for any other text.
std::optional<std::uint32_t> object_number(std::string_view object);

// The size of the longest name with an object's number.
inline constexpr std::size_t kMaxParameterName = 48;

// Writes the name with the object's number to `room` and returns a view of it; empty for
// Parameter::none.
std::string_view write_parameter_name(const ParameterPlace& place,
                                      std::span<char, kMaxParameterName> room);

}  // namespace tactus::firmware
