#include "drivers/haply_serial/protocol.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "hal/angle.h"

namespace tactus::drivers {

namespace {

constexpr std::uint8_t kHaplyReset = 0;
constexpr std::uint8_t kHaplySetup = 1;
constexpr std::uint8_t kHaplyWriteRead = 2;
constexpr double kHaplyLargestAngle_deg = 36'000.0;

std::uint8_t mask_of_ports(std::size_t count) {
  return static_cast<std::uint8_t>((1U << count) - 1U);
}

// Returns the clamped torque, rounded toward zero if the nearest float lies beyond the limit.
float limited_torque(double torque_Nm) {
  if (!std::isfinite(torque_Nm)) {
    return 0.0F;
  }
  const auto rounded =
      static_cast<float>(std::clamp(torque_Nm, -kHaplyTorqueLimit_Nm, kHaplyTorqueLimit_Nm));
  return std::abs(static_cast<double>(rounded)) > kHaplyTorqueLimit_Nm
             ? std::nextafter(rounded, 0.0F)
             : rounded;
}

float float_at(std::span<const std::byte> bytes) {
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    bits |= std::to_integer<std::uint32_t>(bytes[i]) << (8 * i);
  }
  return std::bit_cast<float>(bits);
}

}  // namespace

void HaplyMessage::add(std::uint8_t value) {
  if (size_ < bytes_.size()) {
    bytes_[size_] = static_cast<std::byte>(value);
    ++size_;
  }
}

void HaplyMessage::add(float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  for (unsigned i = 0; i < 4; ++i) {
    add(static_cast<std::uint8_t>(bits >> (8U * i)));
  }
}

HaplyMessage haply_reset(std::uint8_t device_id) {
  HaplyMessage message;
  message.add(kHaplyReset);
  message.add(device_id);
  return message;
}

HaplyMessage haply_setup(std::uint8_t device_id, std::span<const HaplyAxisSetup> axes) {
  const auto used = axes.first(std::min(axes.size(), kHaplyMaxAxes));
  HaplyMessage message;
  message.add(kHaplySetup);
  message.add(device_id);
  message.add(mask_of_ports(used.size()));
  for (const HaplyAxisSetup& axis : used) {
    message.add(static_cast<std::uint8_t>(axis.motor_counter_clockwise ? 1 : 0));
  }
  message.add(mask_of_ports(used.size()));
  for (const HaplyAxisSetup& axis : used) {
    message.add(static_cast<std::uint8_t>(axis.encoder_counter_clockwise ? 1 : 0));
  }
  message.add(std::uint8_t{0});  // analogue inputs
  message.add(std::uint8_t{0});  // PWM outputs
  for (const HaplyAxisSetup& axis : used) {
    message.add(static_cast<float>(hal::degrees_of(axis.angle_now_rad)));
    message.add(static_cast<float>(axis.counts_per_turn));
  }
  return message;
}

HaplyMessage haply_torques(std::uint8_t device_id, std::span<const double> torque_Nm) {
  HaplyMessage message;
  message.add(kHaplyWriteRead);
  message.add(device_id);
  for (const double torque : torque_Nm.first(std::min(torque_Nm.size(), kHaplyMaxAxes))) {
    message.add(limited_torque(torque));
  }
  return message;
}

std::optional<HaplyAngles> decode_haply_reply(std::span<const std::byte> reply,
                                              std::uint8_t device_id, std::size_t axes) {
  if (axes > kHaplyMaxAxes || reply.size() != haply_reply_bytes(axes) ||
      reply[0] != static_cast<std::byte>(device_id)) {
    return std::nullopt;
  }
  HaplyAngles angles{};
  for (std::size_t axis = 0; axis < axes; ++axis) {
    const auto angle_deg = static_cast<double>(float_at(reply.subspan(1 + 4 * axis)));
    if (!(std::abs(angle_deg) <= kHaplyLargestAngle_deg)) {
      return std::nullopt;
    }
    angles[axis] = hal::radians_of(angle_deg);
  }
  return angles;
}

}  // namespace tactus::drivers
