// Whatever a Haply board, or something that says it is one, sends and whenever: no position jump is
// reported as valid, and no torque beyond the board's limit, or at all without being well, goes
// out.

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <span>

#include "drivers/haply_serial/haply.h"
#include "hal/simulated/serial_port.h"
#include "tests/fuzz/board_properties.h"
#include "tests/fuzz/fuzz_input.h"

namespace tactus::fuzz {
namespace {

constexpr hal::TimeNs kMs = 1'000'000;
constexpr std::size_t kTorqueCommandBytes = 10;

constexpr std::size_t kSetupBytes = 26;

drivers::HaplyConfig accepted_config() {
  drivers::HaplyConfig config;
  config.unproven_watchdog = true;
  return config;
}

struct Bench {
  Bench() { host.connect(board); }

  void tick(double torque_Nm) {
    driver.read(samples, clock.now_ns() + kMs / 2);
    const auto used = std::span(samples).first(config.axes);
    properties.check(used, driver.trouble(0));
    std::array<drivers::AxisCommand, drivers::kHaplyMaxAxes> commands;
    commands.fill({.torque_Nm = torque_Nm, .enable = true});
    driver.write(commands);
    check_command();
    clock.advance_by(kMs / 2);
  }

  // Decoded by hand.
  void check_command() {
    std::array<std::byte, 4096> heard{};
    const auto got = board.read(heard, hal::kNoWait);
    if (got && *got >= kSetupBytes) {  // the angles that the board is to count from
      std::memcpy(&told_deg[0], heard.data() + *got - 16, 4);
      std::memcpy(&told_deg[1], heard.data() + *got - 8, 4);
    }
    driver_asked = got && *got == kTorqueCommandBytes && heard[0] == std::byte{2};
    if (!driver_asked) {
      return;
    }
    for (std::size_t axis = 0; axis < config.axes; ++axis) {
      float torque = 0.0F;
      std::memcpy(&torque, heard.data() + 2 + 4 * axis, sizeof torque);
      require(static_cast<double>(torque) >= -0.123 && static_cast<double>(torque) <= 0.123,
              "no torque beyond the limit");
      const bool is_well = (samples[0].status & ~std::uint32_t{drivers::kDeviceStale}) == 0;
      require(is_well || torque == 0.0F, "no torque from a board that is not well");
    }
  }

  void say(float first_deg, float second_deg) {
    std::array<std::byte, 9> answer{std::byte{5}};
    std::memcpy(answer.data() + 1, &first_deg, 4);
    std::memcpy(answer.data() + 5, &second_deg, 4);
    (void)board.write(answer, hal::kNoWait);
  }

  void bring_up() {
    check_command();
    for (int i = 0; i < 200 && samples[0].status != drivers::kDeviceOk; ++i) {
      tick(0.0);
      if (driver_asked) {
        say(told_deg[0], told_deg[1]);
      }
    }
  }

  std::array<float, 2> told_deg{};
  bool driver_asked = false;  // a command of torques went out in the last tick
  hal::SimulatedClock clock;
  hal::SimulatedSerialPort host{clock};
  hal::SimulatedSerialPort board{clock};
  drivers::HaplyConfig config = accepted_config();
  drivers::Haply driver{host, clock, config};
  std::array<drivers::AxisSample, drivers::kHaplyMaxAxes> samples{};
  BoardProperties properties{{.fastest_rad_per_s = config.fastest_rad_per_s, .slack_rad = 0.005}};
};

void run(FuzzInput input) {
  Bench bench;
  bench.driver.start();
  if (input.below(2) == 1) {
    bench.bring_up();
  }
  while (!input.empty()) {
    switch (input.below(8)) {
      case 0:
      case 1:
        bench.say(0.03F * static_cast<float>(input.take<std::int8_t>()),
                  0.03F * static_cast<float>(input.take<std::int8_t>()));
        break;
      case 2:
        bench.say(input.take<float>(), input.take<float>());
        break;
      case 3: {
        std::array<std::byte, 32> bytes{};
        const std::size_t size = input.below(33);
        input.fill(std::span(bytes).first(size));
        (void)bench.board.write(std::span(bytes).first(size), hal::kNoWait);
        break;
      }
      case 4:
        if (input.below(16) == 0) {
          bench.host.fail_next(1, hal::ErrorCode::io);
        } else if (input.below(16) == 0) {
          bench.properties.forget();
          bench.driver.clear_faults();
        }
        break;
      default:
        bench.tick(input.take<double>());
    }
  }
}

}  // namespace
}  // namespace tactus::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  tactus::fuzz::run(tactus::fuzz::FuzzInput(data, size));
  return 0;
}
