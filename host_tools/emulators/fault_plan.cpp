#include "host_tools/emulators/fault_plan.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <string>

#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

template <class Number>
Number planned_number(std::string_view part, std::string_view whole) {
  Number value{};
  const char* const end = part.data() + part.size();
  const auto [stopped, error] = std::from_chars(part.data(), end, value);
  if (error != std::errc{} || stopped != end || part.empty()) {
    throw InputError(fmt::format(
        "--fault {}: '{}' is not a number; write AXIS:KIND@SECONDS, like 0:silent@3 or all:none@5",
        whole, part));
  }
  return value;
}

}  // namespace

PlannedFault parse_planned_fault(std::string_view text) {
  const std::size_t colon = text.find(':');
  const std::size_t at = text.rfind('@');
  if (colon == std::string_view::npos || at == std::string_view::npos || at < colon) {
    throw InputError(
        fmt::format("--fault {}: write AXIS:KIND@SECONDS, like 0:silent@3 or all:none@5", text));
  }
  PlannedFault planned;
  const std::string_view axis = text.substr(0, colon);
  if (axis != "all") {
    planned.joint = planned_number<std::size_t>(axis, text);
  }
  planned.fault = emulator_fault(text.substr(colon + 1, at - colon - 1));
  planned.at_s = planned_number<double>(text.substr(at + 1), text);
  if (!std::isfinite(planned.at_s) || planned.at_s < 0.0) {
    throw InputError(fmt::format("--fault {}: the time must be 0 s or later", text));
  }
  return planned;
}

}  // namespace tactus::host
