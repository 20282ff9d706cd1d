// No bytes make the driver call a jump a position, or send torque beyond its limit.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>
#include <vector>

#include "hal/simulated/serial_port.h"
#include "tests/unit/drivers/haply_serial/haply_rig.h"

namespace tactus::drivers {
namespace {

// Rubbish, pieces, answers with wild or with tame angles.
std::vector<std::byte> some_answer(std::mt19937& random, const std::array<float, 2>& told_deg) {
  const auto number = [&random](int from, int to) {
    return std::uniform_int_distribution(from, to)(random);
  };
  std::vector<std::byte> bytes = {std::byte{5}};
  const int kind = number(0, 30);
  for (const float home : told_deg) {
    const float angle = home + (kind == 0 ? static_cast<float>(number(-400, 400))
                                          : 0.1F * static_cast<float>(number(-10, 10)));
    std::array<std::byte, 4> part;
    std::memcpy(part.data(), &angle, part.size());
    bytes.insert(bytes.end(), part.begin(), part.end());
  }
  if (kind == 1) {
    bytes[static_cast<std::size_t>(number(0, 8))] = static_cast<std::byte>(number(0, 255));
  } else if (kind == 2) {
    bytes.resize(static_cast<std::size_t>(number(0, 8)));
  } else if (kind == 3) {
    bytes.insert(bytes.end(), bytes.begin(), bytes.begin() + number(0, 9));
  }
  return bytes;
}

TEST(HaplyRandom, NoBytesMakeAJumpOrTorqueBeyondTheLimit) {
  int good_samples = 0;
  for (std::uint32_t seed = 1; seed <= 300; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    hal::SimulatedClock clock;
    hal::SimulatedSerialPort host(clock);
    hal::SimulatedSerialPort board(clock);
    host.connect(board);
    const HaplyConfig config = pantograph_config();
    Haply driver(host, clock, config);
    driver.start();
    clock.advance_by(30'000'000);
    std::array<std::byte, 256> heard;
    std::array<float, 2> told_deg{};
    const auto hear_setup = [&](std::size_t size) {
      std::memcpy(told_deg.data(), heard.data() + size - 16, 4);
      std::memcpy(&told_deg[1], heard.data() + size - 8, 4);
    };
    hear_setup(board.read(heard, hal::kNoWait).value_or(16));
    std::array<AxisSample, kHaplyMaxAxes> samples{};
    std::array<AxisSample, kHaplyMaxAxes> last{};
    bool had_one = false;
    for (int tick = 0; tick < 300; ++tick) {
      driver.read(samples, clock.now_ns() + 500'000);
      if (samples[0].status == kDeviceOk) {
        ++good_samples;
        for (std::size_t axis = 0; had_one && axis < 2; ++axis) {
          const double passed_s =
              static_cast<double>(samples[axis].time_ns - last[axis].time_ns) * 1e-9;
          ASSERT_LE(std::abs(samples[axis].position_rad - last[axis].position_rad),
                    config.fastest_rad_per_s * passed_s + 0.005);
        }
        had_one = true;
        last = samples;
      }
      std::array<AxisCommand, kHaplyMaxAxes> commands;
      commands.fill({.torque_Nm = 0.2, .enable = true});
      driver.write(commands);
      const auto got = board.read(heard, hal::kNoWait);
      if (got && *got >= 26) {
        hear_setup(*got);
      }
      if (got && *got == 10) {
        for (std::size_t axis = 0; axis < 2; ++axis) {
          float torque = 0.0F;
          std::memcpy(&torque, heard.data() + 2 + 4 * axis, sizeof torque);
          ASSERT_LE(std::abs(static_cast<double>(torque)), kHaplyTorqueLimit_Nm);
          if (samples[0].status != kDeviceOk && samples[0].status != kDeviceStale) {
            ASSERT_EQ(torque, 0.0F);
          }
        }
      }
      const auto answer = some_answer(random, told_deg);
      (void)board.write(answer, hal::kNoWait);
      clock.advance_by(1'000'000);
    }
  }
  EXPECT_GT(good_samples, 100);  // or the test shows nothing
}

}  // namespace
}  // namespace tactus::drivers
