// How a parameter is written: "max_force_N", and of an object "object.3.stiffness_N_per_m" or,
// where the scene's names are known, "object.bunny.stiffness_N_per_m".
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

// The parts of a written name; views into it.
struct ParameterName {
  Parameter parameter = Parameter::none;
  std::string_view object;  // between the dots; empty for the controller's own
};

// Nothing if there is no such parameter. Whether there is such an object is not known here.
std::optional<ParameterName> parse_parameter_name(std::string_view text);

// The object of a name that is all digits; nothing for any other.
std::optional<std::uint32_t> object_number(std::string_view object);

// Room for the longest name with an object's number.
inline constexpr std::size_t kMaxParameterName = 48;

// Writes the name with the object's number; a view of what was written, empty for no parameter.
std::string_view write_parameter_name(const ParameterPlace& place,
                                      std::span<char, kMaxParameterName> room);

}  // namespace tactus::firmware
