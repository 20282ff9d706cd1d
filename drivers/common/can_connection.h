// A CAN interface that carries drives, and the time that their frames take on it.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "drivers/common/field_error.h"
#include "drivers/common/setting.h"
#include "drivers/registration.h"

namespace tactus::drivers {

// A CAN interface of the system.
struct CanConnection {
  std::string_view interface;  // "can0"
  double bit_rate = 1e6;       // bit/s, 10'000 to 1'000'000
  double data_bit_rate = 5e6;  // of CAN FD payloads, bit/s, bit_rate to 8'000'000
};

std::span<const Binding<CanConnection>> can_connection_keys();
// Checks every field against its range.
Checked check(const CanConnection& can);
std::string_view shared_key(const CanConnection& one, const CanConnection& other);

inline constexpr ConnectionRegistration<CanConnection> kCanConnection{
    .kind = "can",
    .keys = can_connection_keys,
    .check = check,
    .shared_key = shared_key,
};

enum class CanFormat : bool { standard, extended };

// Returns the bits of a classic frame with so many bytes, with the space behind it and as many
// stuff bits as possible.
double classic_bits(CanFormat format, int bytes);

// Returns the seconds of a CAN FD frame on the bus, with as many stuff bits as possible.
// `switches_rate` says that its payload has the faster bit rate.
double fd_seconds(const CanConnection& bus, bool switches_rate, CanFormat format, int bytes);

}  // namespace tactus::drivers
