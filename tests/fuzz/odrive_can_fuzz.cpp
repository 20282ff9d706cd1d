// Whatever an ODrive, or somebody who speaks in its name, sends and whenever: no position jump is
// reported as valid, and no torque beyond the limit, or at all without being well, goes out.

#include <cmath>
#include <span>

#include "drivers/odrive_can/odrive_can.h"
#include "tests/fuzz/drive_properties.h"
#include "tests/fuzz/fuzz_input.h"

namespace tactus::fuzz {
namespace {

constexpr std::uint8_t kNode = 1;
constexpr drivers::ODriveConfig kAxis{
    .node_id = kNode, .max_torque_Nm = 0.1, .max_speed_rad_per_s = 100.0, .jump_margin_rad = 0.05};

// Decoded by hand: the torque of a Set_Input_Torque frame.
double torque_of(const hal::CanFrame& frame) {
  constexpr std::uint32_t kSetInputTorque = 0x0E;
  if (frame.id != ((std::uint32_t{kNode} << 5U) | kSetInputTorque)) {
    return 0.0;
  }
  float torque_Nm = 0.0F;
  std::memcpy(&torque_Nm, frame.data.data(), sizeof torque_Nm);
  return static_cast<double>(torque_Nm);
}

// What brings a drive up quickly, so that the fuzzer need not find it out: heartbeats and estimates
// that fit.
void play_well(drivers::ODriveCan& drive, hal::TimeNs now_ns, std::uint8_t state) {
  hal::CanFrame heartbeat{.id = (std::uint32_t{kNode} << 5U) | 0x01U, .length = 8};
  heartbeat.data[4] = std::byte{state};
  drive.take({.time_ns = now_ns, .frame = heartbeat});
  drive.take(
      {.time_ns = now_ns, .frame = {.id = (std::uint32_t{kNode} << 5U) | 0x09U, .length = 8}});
}

void bring_up(drivers::ODriveCan& drive, DriveProperties& properties, hal::TimeNs& now_ns,
              bool is_0_6) {
  bool closed = false;
  for (int tick = 0; tick < 500 && drive.sample().status != drivers::kDeviceOk; ++tick) {
    now_ns += 1'000'000;
    play_well(drive, now_ns, closed ? 8 : 1);
    drivers::CanOutbox outbox;
    drive.command(now_ns, {.torque_Nm = 1.0, .enable = true}, outbox);
    properties.check_outbox(drive.sample(), outbox, torque_of);
    for (const hal::CanFrame& frame : outbox.frames()) {
      const std::uint32_t command = frame.id & 0x1FU;
      if (command == 0x00 && is_0_6) {
        hal::CanFrame version{.id = std::uint32_t{kNode} << 5U, .length = 8};
        version.data[0] = std::byte{2};
        drive.take({.time_ns = now_ns, .frame = version});
      } else if (command == 0x07) {
        closed = frame.data[0] == std::byte{8};
      }
    }
  }
}

void run(FuzzInput input) {
  drivers::ODriveCan drive(kAxis);
  DriveProperties properties({.max_torque_Nm = kAxis.max_torque_Nm,
                              .max_speed_rad_per_s = kAxis.max_speed_rad_per_s,
                              .jump_margin_rad = kAxis.jump_margin_rad});
  hal::TimeNs now_ns = 1'000'000'000;
  drive.start(now_ns);
  const auto how = input.take<std::uint8_t>();
  if ((how & 1U) != 0) {
    bring_up(drive, properties, now_ns, (how & 2U) != 0);
  }
  fuzz_drive(drive, properties, now_ns, input, torque_of, [](FuzzInput& bytes) {
    const std::uint32_t id = (std::uint32_t{kNode} << 5U) | bytes.below(32);
    return bytes.frame(bytes.below(64) == 0 ? bytes.below(0x800) : id);
  });
}

}  // namespace
}  // namespace tactus::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  tactus::fuzz::run(tactus::fuzz::FuzzInput(data, size));
  return 0;
}
