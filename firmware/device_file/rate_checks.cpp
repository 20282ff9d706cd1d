// Checks that drives and buses are fast enough for the controller's rate.
#include <algorithm>
#include <span>
#include <variant>

#include "firmware/device_file/bus_load.h"
#include "firmware/device_file/device_checks.h"

namespace tactus::firmware {

namespace {

bool is_encoder_of_a_joint(const DeviceConfig& device, std::size_t axis) {
  return std::ranges::any_of(std::span(device.joints).first(device.joint_count),
                             [axis](const JointConfig& joint) { return joint.encoder == axis; });
}

Verdict check_rate(const DeviceConfig& device, std::size_t i, Words& words) {
  const drivers::AxisUse use{.rate_hz = device.controller.rate_hz,
                             .is_encoder = is_encoder_of_a_joint(device, i)};
  const auto checked = drivers::visit_drive(
      device.axes[i].drive, [&](const auto& driver, const auto& drive) -> drivers::Checked {
        return driver.check_rate == nullptr ? drivers::Checked{}
                                            : driver.check_rate(drive, use, words);
      });
  if (!checked) {
    return std::unexpected(Refusal{Place::axis, i, checked.error().field, checked.error().rule});
  }
  return {};
}

Verdict check_load(const DeviceConfig& device, std::size_t i, Words& words) {
  const double load = bus_load(device, i);
  if (load <= kMaxBusLoad) {
    return {};
  }
  constexpr double kPercent = 100.0;
  words.clear();
  words.add("the bus would be ")
      .add(kPercent * load, 0)
      .add(" % full at rate_hz = ")
      .add(device.controller.rate_hz)
      .add(" and bit_rate = ")
      .add(std::get<drivers::CanConnection>(device.connections[i].line).bit_rate)
      .add(", more than the 90 % that it can carry in time; write a lower rate_hz, ")
      .add("use a faster bit_rate, or give some drives a bus of their own");
  return std::unexpected(Refusal{Place::connection, i, {}, words.view()});
}

}  // namespace

Verdict check_rates(const DeviceConfig& device, Words& words) {
  for (std::size_t i = 0; i < device.axis_count; ++i) {
    if (const Verdict verdict = check_rate(device, i, words); !verdict) {
      return verdict;
    }
  }
  for (std::size_t i = 0; i < device.connection_count; ++i) {
    if (const Verdict verdict = check_load(device, i, words); !verdict) {
      return verdict;
    }
  }
  return {};
}

}  // namespace tactus::firmware
