// The registration of the moteus driver.
#pragma once

#include <numbers>

#include "drivers/common/can_connection.h"
#include "drivers/moteus_canfd/moteus_canfd.h"
#include "drivers/registration.h"

namespace tactus::drivers {

namespace moteus {

bool have_same_number(const MoteusConfig& one, const MoteusConfig& other);
void claim(const MoteusConfig& config, CanIdentifiers& identifiers);
double load(const MoteusConfig& config, const CanConnection& bus, double rate_hz);

}  // namespace moteus

inline constexpr Registration<MoteusConfig, CanConnection, MoteusCanFd> kMoteusDriver{
    .name = "moteus_canfd",
    .keys = moteus_keys,
    .check = [](const MoteusConfig& config, const CanConnection& /*bus*/) { return check(config); },
    .encoder = {.may_be_absolute = true,
                .absolute_is_one_turn = true,
                .turn_begins_rad = -std::numbers::pi},
    .take_encoder =
        [](MoteusConfig& config, EncoderKind encoder) {
          config.absolute_output = encoder == EncoderKind::absolute;
        },
    .watchdog_s = [](const MoteusConfig& config) { return config.watchdog_s; },
    .can = {.speaks_fd = true,
            .number_key = "servo_id",
            .have_same_number = moteus::have_same_number,
            .claim = moteus::claim,
            .load = moteus::load},
};

}  // namespace tactus::drivers
