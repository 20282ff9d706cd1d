// Whatever comes off the bus, a drive that is up or not: no position jump is reported as valid, and
// no torque beyond the limit, or from an axis that is not well, goes out.
#include <gtest/gtest.h>

#include <cmath>

#include "drivers/cia402_can/cia402_can.h"
#include "host_tools/emulators/cia402_emulator.h"
#include "tests/unit/drivers/can_rig.h"
#include "tests/unit/hal/random.h"

namespace tactus::drivers {
namespace {

constexpr double kAnyLimit_Nm = 0.37;

// Read from the wire by hand: 201, controlword, then the torque in 0.1 % of the rated 1 N m.
double wire_torque_Nm(const hal::CanFrame& frame) {
  if (frame.id != 0x201) {
    return 0.0;
  }
  const auto units = static_cast<std::int16_t>(std::to_integer<int>(frame.data[2]) |
                                               std::to_integer<int>(frame.data[3]) << 8);
  return 1e-3 * units;
}

hal::CanFrame wild_frame(hal::Random& random) {
  constexpr std::array<std::uint32_t, 6> kOfTheDrive = {0x181, 0x281, 0x081, 0x581, 0x701, 0x000};
  hal::CanFrame frame{.id = random.one_in(8) ? random.bits() & 0x7FFU
                                             : kOfTheDrive[random.below(kOfTheDrive.size())]};
  frame.length = static_cast<std::uint8_t>(random.one_in(4) ? random.below(9) : 8);
  if (frame.id == 0x281) {
    frame.length = 5;
  } else if (frame.id == 0x701) {
    frame.length = 1;
  }
  for (std::byte& byte : frame.data) {
    byte = static_cast<std::byte>(random.bits() & 0xFFU);
  }
  // Mostly what a healthy drive says, with something wrong in it.
  if (frame.id == 0x181 && !random.one_in(3)) {
    frame.data[0] = std::byte{0x37};
    frame.data[1] = std::byte{0x12};
    for (std::size_t i = 3; i < 6; ++i) {
      frame.data[i] = random.one_in(20) ? frame.data[i] : std::byte{0};
    }
  }
  if (frame.id == 0x281 && !random.one_in(5)) {
    frame.data[4] = std::byte{10};
  }
  if (frame.id == 0x701 && !random.one_in(5)) {
    frame.data[0] = std::byte{5};
  }
  if (frame.id == 0x081 && !random.one_in(5)) {
    frame.id = 0x701;
    frame.length = 1;
    frame.data[0] = std::byte{5};
  }
  return frame;
}

TEST(Cia402Property, NoByteSequenceMakesAJumpOrTorqueBeyondTheLimit) {
  hal::Random random(402402);
  int valid_samples = 0;
  for (int session = 0; session < 40; ++session) {
    CanRig<Cia402Can, host::Cia402Emulator> rig(
        {}, std::vector<Cia402Config>{{.max_torque_Nm = kAnyLimit_Nm}},
        std::vector<host::Cia402EmulatorConfig>{{}});
    hal::SimulatedCanBus stranger(rig.network());
    hal::SimulatedCanBus listener(rig.network());
    rig.start();
    if (!random.one_in(4)) {
      ASSERT_GT(rig.run_until_well(1000 * kMs), 0);
    }
    std::array<hal::CanReceived, 64> heard;
    while (listener.receive(heard, hal::kNoWait)) {
    }
    AxisSample last;
    last.time_ns = 0;
    rig.run(300 * kMs, [&](auto& samples, auto& commands) {
      const AxisSample& sample = samples[0];
      ASSERT_TRUE(std::isfinite(sample.position_rad) && std::isfinite(sample.velocity_rad_per_s));
      if ((sample.status & ~std::uint32_t{kDeviceStale}) == kDeviceOk) {
        ++valid_samples;
        const double passed_s = 1e-9 * static_cast<double>(sample.time_ns - last.time_ns);
        // The margin of the last instant and that of this one.
        ASSERT_TRUE(last.time_ns == 0 || std::abs(sample.position_rad - last.position_rad) <=
                                             400.0 * passed_s + 0.0200001)
            << random.seed() << ' ' << session;
        last = sample;
      } else {
        last.time_ns = 0;
        ASSERT_TRUE(rig.board().trouble(0) || (sample.status & kDeviceNotReady) != 0);
      }
      commands[0] = {.torque_Nm = std::ldexp(static_cast<double>(random.bits()) - 2e9,
                                             static_cast<int>(random.below(80)) - 60),
                     .enable = !random.one_in(10)};
      if (random.one_in(2)) {
        (void)stranger.send(wild_frame(random));
      }
      if (random.one_in(50)) {
        rig.board().clear_faults();
      }
    });
    while (const auto count = listener.receive(heard, hal::kNoWait)) {
      for (std::size_t i = 0; i < *count; ++i) {
        ASSERT_LE(std::abs(wire_torque_Nm(heard[i].frame)), kAnyLimit_Nm + 1e-12)
            << random.seed() << ' ' << session;
      }
    }
  }
  EXPECT_GT(valid_samples, 200);
}

}  // namespace
}  // namespace tactus::drivers
