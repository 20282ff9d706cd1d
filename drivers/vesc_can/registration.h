// The registration of the VESC driver.
#pragma once

#include "drivers/common/can_connection.h"
#include "drivers/registration.h"
#include "drivers/vesc_can/vesc_can.h"

namespace tactus::drivers {

namespace vesc {

bool have_same_number(const VescConfig& one, const VescConfig& other);
void claim(const VescConfig& config, CanIdentifiers& identifiers);
double load(const VescConfig& config, const CanConnection& bus, double rate_hz);
// A VESC reports its position in a status message.
Checked check_rate(const VescConfig& config, const AxisUse& use, Words& words);
std::string_view no_encoder(const VescConfig& config);

}  // namespace vesc

inline constexpr Registration<VescConfig, CanConnection, VescCan> kVescDriver{
    .name = "vesc_can",
    .keys = vesc_keys,
    .check = [](const VescConfig& config, const CanConnection& /*bus*/) { return check(config); },
    .no_encoder = vesc::no_encoder,
    .reference_advice = [](const VescConfig& /*config*/) -> std::string_view {
      return R"(a VESC counts from where it wakes up: "known_pose" or "hard_stop")";
    },
    .check_rate = vesc::check_rate,
    .watchdog_s = [](const VescConfig& config) { return config.watchdog_s; },
    .can = {.number_key = "vesc_id",
            .have_same_number = vesc::have_same_number,
            .claim = vesc::claim,
            .load = vesc::load},
};

}  // namespace tactus::drivers
