#include "drivers/pivot_can/pivot_protocol.h"

#include "drivers/common/little_endian.h"

namespace tactus::drivers::pivot {

// The conversion drops the fraction, so the torque never exceeds the command.
hal::CanFrame command(std::uint8_t node, double torque_Nm) {
  constexpr double kUnits_per_Nm = 1000.0;
  hal::CanFrame frame{.id = command_id(node), .length = kCommandBytes};
  store_little_endian(static_cast<std::int16_t>(kUnits_per_Nm * torque_Nm), frame.data, 0);
  return frame;
}

std::optional<std::int32_t> counts_of(const hal::CanFrame& frame, std::uint8_t node) {
  if (frame.id != answer_id(node) || frame.extended || frame.remote ||
      frame.length != kAnswerBytes) {
    return std::nullopt;
  }
  return load_little_endian<std::int32_t>(frame.bytes(), 0);
}

}  // namespace tactus::drivers::pivot
