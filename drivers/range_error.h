// The first field of a drive's configuration that is out of its range.
#pragma once

#include <optional>
#include <string_view>

namespace tactus::drivers {

struct RangeError {
  std::string_view field;  // as the configuration spells it, unit included
  double value = 0.0;
  double least = 0.0;
  double greatest = 0.0;
};

// Remembers the first field that fails; a value that is not a number fails any range.
class RangeCheck {
 public:
  void within(std::string_view field, double value, double least, double greatest) {
    if (!error_ && !(value >= least && value <= greatest)) {
      error_ = RangeError{field, value, least, greatest};
    }
  }
  [[nodiscard]] const std::optional<RangeError>& error() const { return error_; }

 private:
  std::optional<RangeError> error_;
};

}  // namespace tactus::drivers
