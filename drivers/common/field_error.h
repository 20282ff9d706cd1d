// The reason for which a configuration is refused.
#pragma once

#include <cmath>
#include <expected>
#include <string_view>

namespace tactus::drivers {

// Names one field and the rule that it breaks. The texts live as long as the program.
struct FieldError {
  std::string_view field;  // its name in the struct
  std::string_view rule;   // "must lie between 0.001 and 1"
};

using Checked = std::expected<void, FieldError>;

// Returns true if low <= value <= high; false for NaN and infinity.
inline bool lies_between(double value, double low, double high) {
  return std::isfinite(value) && value >= low && value <= high;
}

// Returns true for the path of a file from the root on.
inline bool is_absolute_path(std::string_view text) {
  return text.size() > 1 && text[0] == '/';
}

}  // namespace tactus::drivers
