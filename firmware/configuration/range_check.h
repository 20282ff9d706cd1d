// Checks a configuration field by field and keeps the first error.
#pragma once

#include <expected>
#include <string_view>

#include "firmware/configuration/controller_config.h"

namespace tactus::firmware {

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

}  // namespace tactus::firmware
