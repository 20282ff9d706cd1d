// The registration of the driver of CANopen drives with CiA 402.
#pragma once

#include "drivers/cia402_can/cia402_can.h"
#include "drivers/common/can_connection.h"
#include "drivers/registration.h"

namespace tactus::drivers {

namespace cia402 {

void claim(const Cia402Config& config, CanIdentifiers& identifiers);
double load(const Cia402Config& config, const CanConnection& bus, double rate_hz);
// The period of the SYNC is that of the ticks.
Checked check_rate(const Cia402Config& config, const AxisUse& use, Words& words);

}  // namespace cia402

inline constexpr Registration<Cia402Config, CanConnection, Cia402Can> kCia402Driver{
    .name = "cia402_can",
    .keys = cia402_keys,
    .check = [](const Cia402Config& config, const CanConnection& /*bus*/) { return check(config); },
    .encoder = {.may_be_absolute = true},
    .counts_per_turn = [](const Cia402Config& config) { return config.counts_per_turn; },
    .check_rate = cia402::check_rate,
    .watchdog_s = [](const Cia402Config& config) { return 1e-3 * config.watchdog_ms; },
    .can = {.number_key = "node",
            .have_same_number = [](const Cia402Config& one,
                                   const Cia402Config& other) { return one.node == other.node; },
            .claim = cia402::claim,
            .load = cia402::load,
            .check_bus = check_bus},
};

}  // namespace tactus::drivers
