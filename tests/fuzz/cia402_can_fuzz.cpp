// Whatever a CiA 402 drive, or somebody who speaks in its name, sends and whenever: no position
// jump is reported as valid, and no torque beyond the limit, or at all without being well, goes
// out.

#include <array>

#include "drivers/cia402_can/cia402_can.h"
#include "tests/fuzz/drive_properties.h"
#include "tests/fuzz/fuzz_input.h"

namespace tactus::fuzz {
namespace {

// The rated torque stands as configured, so that the torque on the wire can be told without the
// driver: 0.1 % of 1 N m.
constexpr drivers::Cia402Config kAxis{.node = 1,
                                      .max_torque_Nm = 0.1,
                                      .rated_torque_from = drivers::RatedTorque::configured,
                                      .rated_torque_Nm = 1.0,
                                      .max_speed_rad_per_s = 100.0,
                                      .jump_margin_rad = 0.05,
                                      .sdo_timeout_s = 0.05};

// Decoded by hand: the torque of RPDO1.
double torque_of(const hal::CanFrame& frame) {
  if (frame.id != 0x201) {
    return 0.0;
  }
  std::int16_t units = 0;
  std::memcpy(&units, frame.data.data() + 2, sizeof units);
  return 1e-3 * units;
}

// What a healthy drive answers, so that the fuzzer need not find it out.
class HealthyDrive {
 public:
  void hear(const hal::CanFrame& frame, drivers::Cia402Can& drive, hal::TimeNs now_ns) {
    if (frame.id == 0x000) {
      heartbeat_ = frame.data[0] == std::byte{0x01} ? std::byte{0x05} : std::byte{0x00};
      say_heartbeat(drive, now_ns);
    } else if (frame.id == 0x601) {
      drive.take({.time_ns = now_ns, .frame = answer_to(frame)});
    } else if (frame.id == 0x201) {
      controlword_ = frame.data[0];
    }
  }
  void speak(drivers::Cia402Can& drive, hal::TimeNs now_ns) {
    if (heartbeat_ != std::byte{0x05}) {
      return;
    }
    hal::CanFrame state{.id = 0x181, .length = 8};
    state.data[0] = controlword_ == std::byte{0x0F}   ? std::byte{0x37}
                    : controlword_ == std::byte{0x07} ? std::byte{0x33}
                    : controlword_ == std::byte{0x06} ? std::byte{0x31}
                                                      : std::byte{0x50};
    state.data[1] = std::byte{0x02};
    drive.take({.time_ns = now_ns, .frame = state});
    hal::CanFrame motion{.id = 0x281, .length = 5};
    motion.data[4] = std::byte{10};
    drive.take({.time_ns = now_ns, .frame = motion});
    say_heartbeat(drive, now_ns);
  }

 private:
  static hal::CanFrame answer_to(const hal::CanFrame& question) {
    hal::CanFrame answer = question;
    answer.id = 0x581;
    if (question.data[0] != std::byte{0x40}) {
      answer.data[0] = std::byte{0x60};
      return answer;
    }
    answer.data[0] = std::byte{0x43};
    const bool is_type = question.data[1] == std::byte{0x00};
    answer.data[4] = is_type ? std::byte{0x92} : std::byte{0x00};
    answer.data[5] = is_type ? std::byte{0x01} : std::byte{0x02};
    return answer;
  }
  void say_heartbeat(drivers::Cia402Can& drive, hal::TimeNs now_ns) const {
    hal::CanFrame frame{.id = 0x701, .length = 1};
    frame.data[0] = heartbeat_;
    drive.take({.time_ns = now_ns, .frame = frame});
  }

  std::byte heartbeat_{0x7F};
  std::byte controlword_{0};
};

void bring_up(drivers::Cia402Can& drive, DriveProperties& properties, hal::TimeNs& now_ns) {
  HealthyDrive healthy;
  for (int tick = 0; tick < 100; ++tick) {
    now_ns += 1'000'000;
    drivers::CanOutbox outbox;
    drive.request(now_ns, outbox);
    healthy.speak(drive, now_ns);
    outbox.clear();
    drive.command(now_ns, {.torque_Nm = 1.0, .enable = true}, outbox);
    properties.check_outbox(drive.sample(), outbox, torque_of);
    for (const hal::CanFrame& frame : outbox.frames()) {
      healthy.hear(frame, drive, now_ns);
    }
  }
  require(drive.sample().status == drivers::kDeviceOk, "a healthy drive comes up");
}

void run(FuzzInput input) {
  drivers::Cia402Can drive(kAxis);
  DriveProperties properties({.max_torque_Nm = kAxis.max_torque_Nm,
                              .max_speed_rad_per_s = kAxis.max_speed_rad_per_s,
                              .jump_margin_rad = 2.0 * kAxis.jump_margin_rad});
  hal::TimeNs now_ns = 1'000'000'000;
  drive.start(now_ns);
  if ((input.take<std::uint8_t>() & 1U) != 0) {
    bring_up(drive, properties, now_ns);
  }
  fuzz_drive(drive, properties, now_ns, input, torque_of, [](FuzzInput& bytes) {
    constexpr std::array<std::uint32_t, 6> kServices = {0x181, 0x281, 0x081, 0x581, 0x701, 0x000};
    const std::uint32_t id = kServices[bytes.below(kServices.size())];
    return bytes.frame(bytes.below(64) == 0 ? bytes.below(0x800) : id);
  });
}

}  // namespace
}  // namespace tactus::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  tactus::fuzz::run(tactus::fuzz::FuzzInput(data, size));
  return 0;
}
