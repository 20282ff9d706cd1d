// Checks a configuration field by field and keeps the first error. One thread; no heap.
#pragma once

#include <expected>
#include <string_view>

#include "firmware/configuration/controller_config.h"

namespace tactus::firmware {

class RangeCheck {
 public:
  // Notes an error if the value is outside the closed range and no error was noted before. NaN is
  // out of every range. The field's name must stay valid.
  void in(std::string_view field, double value, double least, double greatest) {
    const bool inside = value >= least && value <= greatest;
    if (good_ && !inside) {
      good_ = false;
      error_ = {field, value, least, greatest};
    }
  }

  // Returns the first error, if there is one.
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
