// The registration of the ODrive driver.
#pragma once

#include "drivers/common/can_connection.h"
#include "drivers/odrive_can/odrive_can.h"
#include "drivers/registration.h"

namespace tactus::drivers {

namespace odrive {

void claim(const ODriveConfig& config, CanIdentifiers& identifiers);
double load(const ODriveConfig& config, const CanConnection& bus, double rate_hz);
// A drive reports its position by its own clock once a millisecond at most.
Checked check_rate(const ODriveConfig& config, const AxisUse& use, Words& words);

}  // namespace odrive

inline constexpr Registration<ODriveConfig, CanConnection, ODriveCan> kODriveDriver{
    .name = "odrive_can",
    .keys = odrive_keys,
    .check = [](const ODriveConfig& config, const CanConnection& /*bus*/) { return check(config); },
    .encoder = {.may_be_absolute = true},
    .check_rate = odrive::check_rate,
    .watchdog_s = [](const ODriveConfig& config) { return config.watchdog_s; },
    .watchdog_advice = {"with firmware 0.5 any frame to its node feeds it",
                        "let no other program on the bus ask this drive anything, or it keeps a "
                        "dead host's torque alive"},
    .can = {.number_key = "node_id",
            .have_same_number =
                [](const ODriveConfig& one, const ODriveConfig& other) {
                  return one.node_id == other.node_id;
                },
            .claim = odrive::claim,
            .load = odrive::load},
};

}  // namespace tactus::drivers
