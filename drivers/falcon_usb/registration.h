// The registration of the Novint Falcon: its connection and its arms.
#pragma once

#include <cstdint>
#include <string_view>

#include "drivers/falcon_usb/falcon.h"
#include "drivers/registration.h"

namespace tactus::drivers {

// A Falcon on USB.
struct FalconConnection {
  std::string_view firmware_file;  // uploaded when the device has none; empty: none
  // The serial number of the Falcon, as lsusb shows it; empty: the first one found.
  std::string_view serial;
  FalconConfig falcon;
};

// One of its arms.
struct FalconAxis {
  std::uint8_t number = 0;
};

namespace falcon {

std::span<const Binding<FalconConnection>> connection_keys();
std::span<const Binding<FalconAxis>> keys();
Checked check(const FalconAxis& axis, const FalconConnection& connection);
std::string_view shared_key(const FalconConnection& one, const FalconConnection& other);

}  // namespace falcon

inline constexpr ConnectionRegistration<FalconConnection> kFalconConnection{
    .kind = "falcon_usb",
    .keys = falcon::connection_keys,
    .check = [](const FalconConnection& /*connection*/) { return Checked{}; },
    .shared_key = falcon::shared_key,
    .sharing_advice = "write the serial number of each, as lsusb -v -d 0403:cb48 shows it",
    .accepts_unproven_watchdog =
        [](const FalconConnection& connection) { return connection.falcon.unproven_watchdog; },
};

inline constexpr Registration<FalconAxis, FalconConnection> kFalconDriver{
    .name = "falcon_usb",
    .keys = falcon::keys,
    .check = falcon::check,
    .finds_own_reference = true,
    .reference_advice = [](const FalconAxis& /*axis*/) -> std::string_view {
      return R"(a Falcon finds its own reference: write reference = "board")";
    },
    .number_on_board = [](const FalconAxis& axis) -> std::size_t { return axis.number; },
};

}  // namespace tactus::drivers
