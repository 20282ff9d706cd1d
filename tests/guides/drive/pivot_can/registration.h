// The registration of the Pivot driver.
#pragma once

#include "drivers/common/can_connection.h"
#include "drivers/pivot_can/pivot_can.h"
#include "drivers/registration.h"

namespace tactus::drivers {

namespace pivot {

void claim(const PivotConfig& config, CanIdentifiers& identifiers);
double load(const PivotConfig& config, const CanConnection& bus, double rate_hz);

}  // namespace pivot

inline constexpr Registration<PivotConfig, CanConnection, PivotCan> kPivotDriver{
    .name = "pivot_can",
    .keys = pivot_keys,
    .check = [](const PivotConfig& config, const CanConnection& /*bus*/) { return check(config); },
    .counts_per_turn = [](const PivotConfig& config) { return config.counts_per_turn; },
    .can = {.number_key = "node",
            .have_same_number = [](const PivotConfig& one,
                                   const PivotConfig& other) { return one.node == other.node; },
            .claim = pivot::claim,
            .load = pivot::load},
};

}  // namespace tactus::drivers
