#include "drivers/cia402_can/registration.h"

#include <cmath>

#include "drivers/cia402_can/canopen.h"
#include "drivers/common/tick_rate.h"

namespace tactus::drivers::cia402 {

// NMT and SYNC are claimed as well; all drives of the bus share them.
void claim(const Cia402Config& config, CanIdentifiers& identifiers) {
  for (const std::uint32_t service :
       {canopen::kEmergency, canopen::kTransmitPdo1, canopen::kReceivePdo1, canopen::kTransmitPdo2,
        canopen::kSdoAnswer, canopen::kSdoRequest, canopen::kHeartbeat}) {
    identifiers.add_standard(service + config.node);
  }
  identifiers.add_standard(canopen::kNmt);
  identifiers.add_standard(canopen::kSync);
  identifiers.add_standard(canopen::kHeartbeat +
                           static_cast<std::uint32_t>(heartbeat_node(config)));
}

// Each SYNC has PDOs with controlword and torque, with statusword, position and torque, and, if
// asked for, with velocity and mode. The drive sends heartbeats, and the host sends some for it
// alone.
double load(const Cia402Config& config, const CanConnection& bus, double rate_hz) {
  constexpr double kMilliseconds = 1000.0;
  constexpr double kHeartbeatsPerWatchdog = 4.0;
  const double heartbeat = classic_bits(CanFormat::standard, 1);
  double tick = classic_bits(CanFormat::standard, 4) + classic_bits(CanFormat::standard, 8);
  tick += config.velocity_unit_rad_per_s > 0.0 ? classic_bits(CanFormat::standard, 5) : 0.0;
  tick += config.leads_bus ? classic_bits(CanFormat::standard, 0) : 0.0;
  const double host = kHeartbeatsPerWatchdog * kMilliseconds / config.watchdog_ms;
  const double bits =
      rate_hz * tick + heartbeat * (kMilliseconds / config.drive_heartbeat_ms + host);
  return bits / bus.bit_rate;
}

Checked check_rate(const Cia402Config& config, const AxisUse& use, Words& words) {
  if (std::abs(config.period_s * use.rate_hz - 1.0) <= kPeriodTolerance) {
    return {};
  }
  say_period("is ", config.period_s, use.rate_hz, words);
  words.add("period_s = ")
      .add(1.0 / use.rate_hz, 6)
      .add(" if the drive can, or rate_hz = ")
      .add(1.0 / config.period_s);
  return std::unexpected(FieldError{"period_s", words.view()});
}

}  // namespace tactus::drivers::cia402
