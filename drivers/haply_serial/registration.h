// The registration of the Haply board: its connection and its axes.
#pragma once

#include <cstdint>
#include <string_view>

#include "drivers/haply_serial/haply.h"
#include "drivers/registration.h"

namespace tactus::drivers {

// A Haply board on a serial port.
struct HaplyConnection {
  std::string_view port;  // "/dev/ttyACM0"
  HaplyConfig haply;
};

// One of its axes.
struct HaplyAxis {
  std::uint8_t number = 0;
};

namespace haply {

std::span<const Binding<HaplyConnection>> connection_keys();
Checked check(const HaplyConnection& connection);
std::string_view shared_key(const HaplyConnection& one, const HaplyConnection& other);

std::span<const Binding<HaplyAxis>> keys();
Checked check(const HaplyAxis& axis, const HaplyConnection& connection);
void stand_at(HaplyConnection& connection, const HaplyAxis& axis, double home_rad);

}  // namespace haply

inline constexpr ConnectionRegistration<HaplyConnection> kHaplyConnection{
    .kind = "haply_serial",
    .keys = haply::connection_keys,
    .check = haply::check,
    .shared_key = haply::shared_key,
    .accepts_unproven_watchdog =
        [](const HaplyConnection& connection) { return connection.haply.unproven_watchdog; },
};

inline constexpr Registration<HaplyAxis, HaplyConnection> kHaplyDriver{
    .name = "haply_serial",
    .keys = haply::keys,
    .check = haply::check,
    .reference_advice = [](const HaplyAxis& /*axis*/) -> std::string_view {
      return R"(a Haply board counts from where its arms are when it is set up: "known_pose" or )"
             R"("hard_stop")";
    },
    .stand_at = haply::stand_at,
    .number_on_board = [](const HaplyAxis& axis) -> std::size_t { return axis.number; },
};

}  // namespace tactus::drivers
