#include "drivers/pivot_can/registration.h"

#include "drivers/pivot_can/pivot_protocol.h"

namespace tactus::drivers::pivot {

void claim(const PivotConfig& config, CanIdentifiers& identifiers) {
  identifiers.add_standard(command_id(config.node));
  identifiers.add_standard(answer_id(config.node));
}

double load(const PivotConfig& /*config*/, const CanConnection& bus, double rate_hz) {
  const double bits = classic_bits(CanFormat::standard, kCommandBytes) +
                      classic_bits(CanFormat::standard, kAnswerBytes);
  return rate_hz * bits / bus.bit_rate;
}

}  // namespace tactus::drivers::pivot
