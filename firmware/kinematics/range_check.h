// Checks a configuration field by field and keeps the first error.
#pragma once

#include <expected>
#include <string_view>

#include "firmware/kinematics/link_weight.h"

namespace tactus::firmware {

// An error in a configuration: the field as written in the header of its struct, its value, and the
// allowed closed range.
struct ConfigError {
  std::string_view field;
  double value = 0.0;
  double least = 0.0;
  double greatest = 0.0;
};

// Remembers the first value that is out of range. NaN is out of every range.
class RangeCheck {
 public:
  void in(std::string_view field, double value, double least, double greatest) {
    const bool inside = value >= least && value <= greatest;
    if (good_ && !inside) {
      good_ = false;
      error_ = {field, value, least, greatest};
    }
  }

  [[nodiscard]] std::expected<void, ConfigError> result() const {
    if (good_) {
      return {};
    }
    return std::unexpected(error_);
  }

 private:
  bool good_ = true;
  ConfigError error_;
};

// The bounds of dimensions and weights of a desktop device.
inline constexpr double kShortestLink_m = 0.001;
inline constexpr double kLongestLink_m = 1.0;
inline constexpr double kHeaviestLink_kg = 10.0;

inline void check_mass(RangeCheck& check, std::string_view field, double mass_kg) {
  check.in(field, mass_kg, 0.0, kHeaviestLink_kg);
}

inline void check_link(RangeCheck& check, std::string_view field, double length_m) {
  check.in(field, length_m, kShortestLink_m, kLongestLink_m);
}

struct WeightFields {
  std::string_view mass;
  std::string_view centre;
};

inline void check_weight(RangeCheck& check, const WeightFields& fields, const LinkWeight& weight) {
  check_mass(check, fields.mass, weight.mass_kg);
  check.in(fields.centre, weight.centre_m, -kLongestLink_m, kLongestLink_m);
}

}  // namespace tactus::firmware
