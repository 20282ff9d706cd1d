#include "drivers/vesc_can/registration.h"

#include "drivers/common/tick_rate.h"

namespace tactus::drivers::vesc {

bool have_same_number(const VescConfig& one, const VescConfig& other) {
  return one.vesc_id == other.vesc_id || one.vesc_id == other.host_id ||
         one.host_id == other.vesc_id;
}

void claim(const VescConfig& config, CanIdentifiers& identifiers) {
  constexpr std::uint32_t kPackets = 64;
  constexpr std::uint32_t kShortBuffer = 8;
  for (std::uint32_t packet = 0; packet < kPackets; ++packet) {
    identifiers.add_extended(packet << 8U | config.vesc_id);
  }
  identifiers.add_extended(kShortBuffer << 8U | config.host_id);
}

double load(const VescConfig& config, const CanConnection& bus, double rate_hz) {
  const double message = classic_bits(CanFormat::extended, 8);
  const double status = message * (config.offers_position ? 3.0 : 1.0) / config.status_period_s;
  const double bits = rate_hz * classic_bits(CanFormat::extended, 6) + status +
                      2.0 * message / config.poll_period_s;
  return bits / bus.bit_rate;
}

Checked check_rate(const VescConfig& config, const AxisUse& use, Words& words) {
  if (!use.is_encoder || !is_slower(config.status_period_s, use.rate_hz)) {
    return {};
  }
  say_period("is ", config.status_period_s, use.rate_hz, words);
  words.add("rate_hz = ")
      .add(1.0 / config.status_period_s)
      .add(" or less, or set the status rate in VESC Tool higher and write its period here");
  return std::unexpected(FieldError{"status_period_s", words.view()});
}

std::string_view no_encoder(const VescConfig& config) {
  return config.offers_position
             ? ""
             : "a VESC that reports no position; write offers_position = true there, or name the "
               "axis of another encoder";
}

}  // namespace tactus::drivers::vesc
