#include "drivers/common/can_connection.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace tactus::drivers {

namespace {

constexpr std::string_view kInterfaceRule =
    "must be the name of a network interface, 1 to 15 characters without '/', ':' and white space: "
    "\"can0\"; see ip link show type can";

bool is_interface_name(std::string_view name) {
  constexpr std::size_t kLongest = 15;  // IFNAMSIZ less its end
  return !name.empty() && name.size() <= kLongest && name != "." && name != ".." &&
         std::ranges::none_of(name, [](char c) {
           return c == '/' || c == ':' || static_cast<unsigned char>(c) <= ' ';
         });
}

}  // namespace

std::span<const Binding<CanConnection>> can_connection_keys() {
  using C = CanConnection;
  static constexpr std::array kKeys{
      bind<&C::interface>("interface"),
      bind<&C::bit_rate>("bit_rate", {}, {10e3, 1e6, "must lie between 10000 and 1000000"}),
      bind<&C::data_bit_rate>("data_bit_rate"),
  };
  return kKeys;
}

Checked check(const CanConnection& can) {
  if (!is_interface_name(can.interface)) {
    return std::unexpected(FieldError{"interface", kInterfaceRule});
  }
  if (const auto in_range = check_ranges(can, can_connection_keys()); !in_range) {
    return in_range;
  }
  if (!lies_between(can.data_bit_rate, can.bit_rate, 8e6)) {
    return std::unexpected(FieldError{"data_bit_rate", "must lie between bit_rate and 8000000"});
  }
  return {};
}

std::string_view shared_key(const CanConnection& one, const CanConnection& other) {
  return one.interface == other.interface ? "interface" : "";
}

// The part up to the end of the checksum may have a stuff bit after each four bits (the first after
// five).
double classic_bits(CanFormat format, int bytes) {
  const int stuffed = (format == CanFormat::standard ? 34 : 54) + 8 * bytes;
  constexpr int kNeverStuffed = 13;
  const int stuff_bits = (stuffed - 1) / 4;
  return stuffed + kNeverStuffed + stuff_bits;
}

// The identifier has the nominal rate and the payload the data rate. Both parts may have a stuff
// bit after each four bits; the checksum has them at fixed places.
double fd_seconds(const CanConnection& bus, bool switches_rate, CanFormat format, int bytes) {
  const int head = format == CanFormat::standard ? 17 : 36;
  constexpr int kTail = 13;
  constexpr int kLongestShortPayload = 16;
  const int payload = 5 + 8 * bytes;
  const int checksum = bytes <= kLongestShortPayload ? 27 : 32;
  const int head_stuff_bits = head / 4;
  const int payload_stuff_bits = payload / 4;
  const double nominal = head + head_stuff_bits + kTail;
  const double fast = payload + payload_stuff_bits + checksum;
  return nominal / bus.bit_rate + fast / (switches_rate ? bus.data_bit_rate : bus.bit_rate);
}

}  // namespace tactus::drivers
