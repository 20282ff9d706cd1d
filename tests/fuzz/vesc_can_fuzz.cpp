// Whatever a VESC, or somebody who speaks in its name, sends and whenever: no position jump is
// reported as valid, and no torque beyond the limit, or at all without being well, goes out.

#include <array>
#include <initializer_list>
#include <numbers>

#include "drivers/vesc_can/vesc_can.h"
#include "tests/fuzz/drive_properties.h"
#include "tests/fuzz/fuzz_input.h"

namespace tactus::fuzz {
namespace {

constexpr drivers::VescConfig kAxis{.vesc_id = 1,
                                    .host_id = 2,
                                    .torque_constant_Nm_per_A = 0.05,
                                    .max_torque_Nm = 0.1,
                                    .offers_position = true,
                                    .max_speed_rad_per_s = 100.0,
                                    .jump_margin_rad = 0.05};
constexpr double kCount_rad = 2.0 * std::numbers::pi / (6.0 * kAxis.pole_pairs);

// Decoded by hand: the current of a set-current frame, in mA, times the torque constant.
double torque_of(const hal::CanFrame& frame) {
  if (frame.id != 0x101 || !frame.extended) {
    return 0.0;
  }
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    bits = bits << 8U | std::to_integer<std::uint32_t>(frame.data[i]);
  }
  // Less by what the products of the limit and of this one may differ in their last bit.
  return (1.0 - 1e-12) * 1e-3 * kAxis.torque_constant_Nm_per_A * static_cast<std::int32_t>(bits);
}

void say(drivers::VescCan& drive, hal::TimeNs now_ns, std::uint32_t id,
         std::initializer_list<std::uint8_t> bytes) {
  hal::CanFrame frame{.id = id, .extended = true, .length = 8};
  std::size_t at = 0;
  for (const std::uint8_t byte : bytes) {
    frame.data[at++] = std::byte{byte};
  }
  drive.take({.time_ns = now_ns, .frame = frame});
}

void bring_up(drivers::VescCan& drive, DriveProperties& properties, hal::TimeNs& now_ns) {
  for (int tick = 0; tick < 5; ++tick) {
    now_ns += 1'000'000;
    say(drive, now_ns, 0x901, {});
    say(drive, now_ns, 0x1B01, {});
    say(drive, now_ns, 0x802, {0x01, 0x01, 0x32, 0x00, 0x00, 0x80, 0x00, 0x00});
    drivers::CanOutbox outbox;
    drive.command(now_ns, {.torque_Nm = 1.0, .enable = true}, outbox);
    properties.check_outbox(drive.sample(), outbox, torque_of);
  }
  require(drive.sample().status == drivers::kDeviceOk, "a healthy VESC comes up");
}

void run(FuzzInput input) {
  drivers::VescCan drive(kAxis);
  DriveProperties properties({.max_torque_Nm = kAxis.max_torque_Nm,
                              .max_speed_rad_per_s = kAxis.max_speed_rad_per_s,
                              .jump_margin_rad = 2.0 * (kAxis.jump_margin_rad + 2.0 * kCount_rad)});
  hal::TimeNs now_ns = 1'000'000'000;
  drive.start(now_ns);
  if ((input.take<std::uint8_t>() & 1U) != 0) {
    bring_up(drive, properties, now_ns);
  }
  fuzz_drive(drive, properties, now_ns, input, torque_of, [](FuzzInput& bytes) {
    constexpr std::array<std::uint32_t, 4> kPackets = {0x901, 0x1001, 0x1B01, 0x802};
    const std::uint32_t packet = kPackets[bytes.below(kPackets.size())];
    hal::CanFrame frame = bytes.frame(bytes.below(64) == 0 ? bytes.below(0x10000) : packet);
    frame.extended = frame.id > hal::kMaxStandardId || bytes.below(16) != 0;
    return frame;
  });
}

}  // namespace
}  // namespace tactus::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  tactus::fuzz::run(tactus::fuzz::FuzzInput(data, size));
  return 0;
}
