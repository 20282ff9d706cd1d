#include "firmware/device_file/can_identifiers.h"

#include <algorithm>
#include <variant>

namespace tactus::firmware {

namespace {

drivers::CanIdentifiers identifiers_of(const AxisConfig& axis) {
  drivers::CanIdentifiers identifiers;
  drivers::visit_drive(axis.drive, [&](const auto& driver, const auto& drive) {
    if (driver.can.claim != nullptr) {
      driver.can.claim(drive, identifiers);
    }
  });
  return identifiers;
}

}  // namespace

std::string_view number_key(const AxisConfig& axis) {
  return drivers::visit_drive(
      axis.drive, [](const auto& driver, const auto& /*drive*/) { return driver.can.number_key; });
}

bool have_same_number(const AxisConfig& one, const AxisConfig& other) {
  return drivers::visit_drive(one.drive, [&other](const auto& driver, const auto& drive) {
    const auto* also = std::get_if<std::remove_cvref_t<decltype(drive)>>(&other.drive);
    return also != nullptr && driver.can.have_same_number != nullptr &&
           driver.can.have_same_number(drive, *also);
  });
}

std::optional<drivers::CanIdentifier> shared_identifier(const AxisConfig& one,
                                                        const AxisConfig& other) {
  if (one.drive.index() == other.drive.index()) {
    return std::nullopt;
  }
  const drivers::CanIdentifiers ids = identifiers_of(one);
  const drivers::CanIdentifiers others = identifiers_of(other);
  for (const drivers::CanIdentifier& id : ids.all()) {
    if (std::ranges::find(others.all(), id) != others.all().end()) {
      return id;
    }
  }
  return std::nullopt;
}

}  // namespace tactus::firmware
