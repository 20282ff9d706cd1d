#include "drivers/odrive_can/registration.h"

#include "drivers/common/tick_rate.h"

namespace tactus::drivers::odrive {

namespace {

constexpr double kFastest_s = 0.001;  // encoder_rate_ms is a whole number

}  // namespace

void claim(const ODriveConfig& config, CanIdentifiers& identifiers) {
  constexpr std::uint32_t kCommands = 32;
  for (std::uint32_t command = 0; command < kCommands; ++command) {
    identifiers.add_standard(config.node_id * kCommands + command);
  }
}

// An estimate has eight bytes, a torque four.
double load(const ODriveConfig& config, const CanConnection& bus, double rate_hz) {
  constexpr double kHeartbeat_s = 0.01;  // the setting in README.md
  const double message = classic_bits(CanFormat::standard, 8);
  const double question = classic_bits(CanFormat::standard, 0);
  const bool asks = config.estimates == ODriveEstimates::requested;
  double bits = rate_hz * classic_bits(CanFormat::standard, 4) + message / kHeartbeat_s;
  bits += asks ? rate_hz * (question + message) : message / kFastest_s;
  for (const double period_s : {config.poll_period_s, config.torque_period_s}) {
    bits += period_s > 0.0 ? (question + message) / period_s : 0.0;
  }
  return bits / bus.bit_rate;
}

Checked check_rate(const ODriveConfig& config, const AxisUse& use, Words& words) {
  if (!use.is_encoder || config.estimates != ODriveEstimates::cyclic ||
      !is_slower(kFastest_s, use.rate_hz)) {
    return {};
  }
  say_period("come every ", kFastest_s, use.rate_hz, words);
  words.add(R"(estimates = "requested", or rate_hz = 1000 or less)");
  return std::unexpected(FieldError{"estimates", words.view()});
}

}  // namespace tactus::drivers::odrive
