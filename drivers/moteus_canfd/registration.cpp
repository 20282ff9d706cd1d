#include "drivers/moteus_canfd/registration.h"

namespace tactus::drivers::moteus {

bool have_same_number(const MoteusConfig& one, const MoteusConfig& other) {
  return one.prefix == other.prefix &&
         (one.servo_id == other.servo_id || one.servo_id == other.host_id ||
          one.host_id == other.servo_id);
}

// A servo takes and sends short identifiers in standard and extended frames.
void claim(const MoteusConfig& config, CanIdentifiers& identifiers) {
  constexpr std::uint32_t kWantsAnswer = 0x8000;
  constexpr std::uint32_t kShortest = 0x800;
  const std::uint32_t prefix = std::uint32_t{config.prefix} << 16U;
  const std::uint32_t command = prefix | std::uint32_t{config.host_id} << 8U | config.servo_id;
  const std::uint32_t answer = prefix | std::uint32_t{config.servo_id} << 8U | config.host_id;
  for (const std::uint32_t id : {command, command | kWantsAnswer, answer}) {
    identifiers.add_extended(id);
    if (id < kShortest) {
      identifiers.add_standard(id);
    }
  }
}

double load(const MoteusConfig& config, const CanConnection& bus, double rate_hz) {
  constexpr int kTorqueBytes = 48;
  constexpr int kAnswerBytes = 32;
  constexpr int kQueryBytes = 8;
  const auto seconds = [&](int bytes) {
    return fd_seconds(bus, config.bit_rate_switch, CanFormat::extended, bytes);
  };
  const bool asks = config.query == MoteusQuery::before_command;
  return rate_hz *
         (seconds(kTorqueBytes) + seconds(kAnswerBytes) + (asks ? seconds(kQueryBytes) : 0.0));
}

}  // namespace tactus::drivers::moteus
