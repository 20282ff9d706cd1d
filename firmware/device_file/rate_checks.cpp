// Checks that drives and buses are fast enough for the controller's rate.
#include <algorithm>
#include <cmath>
#include <span>
#include <variant>

#include "firmware/device_file/bus_load.h"
#include "firmware/device_file/device_checks.h"

namespace tactus::firmware {

namespace {

constexpr double kTolerance = 0.01;  // of a period: allowed for rounding

std::unexpected<Refusal> refuse_axis(std::size_t axis, std::string_view key, const Words& words) {
  return std::unexpected(Refusal{Place::axis, axis, key, words.view()});
}

bool is_encoder_of_a_joint(const DeviceConfig& device, std::size_t axis) {
  return std::ranges::any_of(std::span(device.joints).first(device.joint_count),
                             [axis](const JointConfig& joint) { return joint.encoder == axis; });
}

void say_period(std::string_view what, double period_s, double rate_hz, Words& words) {
  constexpr int kDecimals = 6;
  words.clear();
  words.add(what)
      .add(period_s, kDecimals)
      .add(" s, but the controller ticks every ")
      .add(1.0 / rate_hz, kDecimals)
      .add(" s (rate_hz = ")
      .add(rate_hz)
      .add("); write ");
}

Verdict check_rate(const DeviceConfig& device, std::size_t i, Words& words) {
  constexpr double kODriveFastest_s = 0.001;  // encoder_rate_ms is a whole number
  const double rate_hz = device.controller.rate_hz;
  const auto& drive = device.axes[i].drive;
  if (const auto* cia402 = std::get_if<drivers::Cia402Config>(&drive);
      cia402 != nullptr && std::abs(cia402->period_s * rate_hz - 1.0) > kTolerance) {
    say_period("is ", cia402->period_s, rate_hz, words);
    words.add("period_s = ")
        .add(1.0 / rate_hz, 6)
        .add(" if the drive can, or rate_hz = ")
        .add(1.0 / cia402->period_s);
    return refuse_axis(i, "period_s", words);
  }
  if (!is_encoder_of_a_joint(device, i)) {
    return {};
  }
  if (const auto* odrive = std::get_if<drivers::ODriveConfig>(&drive);
      odrive != nullptr && odrive->estimates == drivers::ODriveEstimates::cyclic &&
      kODriveFastest_s * rate_hz > 1.0 + kTolerance) {
    say_period(R"(come every )", kODriveFastest_s, rate_hz, words);
    words.add(R"(estimates = "requested", or rate_hz = 1000 or less)");
    return refuse_axis(i, "estimates", words);
  }
  if (const auto* vesc = std::get_if<drivers::VescConfig>(&drive);
      vesc != nullptr && vesc->status_period_s * rate_hz > 1.0 + kTolerance) {
    say_period("is ", vesc->status_period_s, rate_hz, words);
    words.add("rate_hz = ")
        .add(1.0 / vesc->status_period_s)
        .add(" or less, or set the status rate in VESC Tool higher and write its period here");
    return refuse_axis(i, "status_period_s", words);
  }
  return {};
}

Verdict check_load(const DeviceConfig& device, std::size_t i, Words& words) {
  const auto* can = std::get_if<CanConnection>(&device.connections[i].line);
  if (can == nullptr) {
    return {};
  }
  if (!drivers::lies_between(can->bit_rate, 10e3, 1e6)) {
    return std::unexpected(
        Refusal{Place::connection, i, "bit_rate", "must lie between 10000 and 1000000"});
  }
  if (!drivers::lies_between(can->data_bit_rate, can->bit_rate, 8e6)) {
    return std::unexpected(
        Refusal{Place::connection, i, "data_bit_rate", "must lie between bit_rate and 8000000"});
  }
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
      .add(can->bit_rate)
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
