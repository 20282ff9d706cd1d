// Whatever a Falcon, or something that says it is one, sends and whenever: no position jump is
// reported as valid, and no motor value beyond the limit, or at all without being well, goes out.
// The upload of firmware ends, whatever it hears.

#include <array>
#include <cstdint>
#include <span>

#include "drivers/falcon_usb/falcon.h"
#include "hal/simulated/usb_endpoint.h"
#include "tests/fuzz/board_properties.h"
#include "tests/fuzz/fuzz_input.h"

namespace tactus::fuzz {
namespace {

constexpr drivers::FalconConfig kConfig{.torque_limit_Nm = 0.1, .unproven_watchdog = true};
constexpr int kLargestMotor = 1000;
constexpr hal::TimeNs kMs = 1'000'000;

// Takes everything and says nothing by itself. Looks at what it is told.
class Listener final : public hal::SimulatedUsbPeer {
 public:
  hal::Result<std::size_t> control_out(const hal::UsbSetup&, std::span<const std::byte>) override {
    return std::size_t{0};
  }
  hal::Result<std::size_t> control_in(const hal::UsbSetup&, std::span<std::byte>) override {
    return hal::failure(hal::ErrorCode::stalled);
  }
  void bulk_out(std::span<const std::byte> data) override {
    if (data.size() != drivers::kFalconPacketBytes || data[0] != std::byte{'<'}) {
      return;
    }
    // Decoded by hand.
    for (std::size_t arm = 0; arm < 3; ++arm) {
      unsigned bits = 0;
      for (std::size_t i = 0; i < 4; ++i) {
        bits |= (std::to_integer<unsigned>(data[1 + 4 * arm + i]) - 'A') << (4U * i);
      }
      const int motor = static_cast<std::int16_t>(bits);
      require(motor >= -kLargestMotor && motor <= kLargestMotor, "no torque beyond the limit");
      require(is_well || motor == 0, "no torque from a device that is not well");
    }
  }

  bool is_well = false;
};

struct Bench {
  void tick(double torque_Nm) {
    driver.read(samples, clock.now_ns() + kMs / 2);
    properties.check(samples, driver.trouble(0));
    listener.is_well = (samples[0].status & ~std::uint32_t{drivers::kDeviceStale}) == 0;
    std::array<drivers::AxisCommand, 3> commands;
    commands.fill({.torque_Nm = torque_Nm, .enable = true});
    driver.write(commands);
    clock.advance_by(kMs / 2);
  }

  void say(std::span<const std::byte> payload) {
    std::array<std::byte, 64> packet{std::byte{0x31}, std::byte{0x60}};
    const auto part = payload.first(std::min<std::size_t>(payload.size(), 62));
    std::copy(part.begin(), part.end(), packet.begin() + 2);
    endpoint.answer(std::span(packet).first(2 + part.size()));
  }

  void bring_up() {
    drivers::FalconPacket answer = drivers::encode({});
    answer[13] = std::byte{'A' + 0x70};
    for (int i = 0; i < 40 && samples[0].status != drivers::kDeviceOk; ++i) {
      say(answer);
      tick(0.0);
    }
  }

  hal::SimulatedClock clock;
  Listener listener;
  hal::SimulatedUsbEndpoint endpoint{clock, listener};
  drivers::Falcon driver{endpoint, clock, kConfig};
  std::array<drivers::AxisSample, 3> samples{};
  BoardProperties properties{{.fastest_rad_per_s = kConfig.fastest_rad_per_s,
                              .slack_rad = 9 * drivers::kFalconRadPerCount}};
};

// A packet that is one, with counts that the input says.
drivers::FalconPacket packet_of(FuzzInput& input) {
  drivers::FalconCommand command;
  for (std::int16_t& counts : command.motor) {
    counts = input.take<std::int8_t>();
  }
  if (input.below(8) == 0) {
    command.motor[input.below(3)] = input.take<std::int16_t>();
  }
  drivers::FalconPacket packet = drivers::encode(command);
  packet[13] = static_cast<std::byte>('A' + (input.below(8) == 0 ? input.below(128) : 0x70U));
  return packet;
}

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
      case 2:
        bench.say(packet_of(input));
        break;
      case 3: {
        std::array<std::byte, 64> bytes{};
        const std::size_t size = input.below(65);
        input.fill(std::span(bytes).first(size));
        bench.endpoint.answer(std::span(bytes).first(size));
        break;
      }
      case 4:
        if (input.below(16) == 0) {
          bench.endpoint.fail_next(1, hal::ErrorCode::io);
        } else if (input.below(16) == 0) {
          bench.properties.forget();
          bench.driver.clear_faults();
          bench.listener.is_well = false;
        }
        break;
      default:
        bench.tick(input.take<double>());
    }
  }
}

// The upload alone, with any bytes for answers.
void run_upload(FuzzInput input) {
  std::array<std::byte, 200> image{};
  input.fill(image);
  drivers::FalconBringUp bring_up(image);
  hal::TimeNs now_ns = 0;
  bring_up.start(now_ns);
  for (int step = 0; step < 200'000; ++step) {
    const auto action = bring_up.next(now_ns);
    if (bring_up.outcome() != drivers::FalconBringUp::Outcome::under_way) {
      return;
    }
    require(action.bytes.size() <= drivers::kFalconChunkBytes, "a chunk fits a packet");
    if (action.kind == drivers::FalconBringUp::Action::Kind::nothing) {
      now_ns += kMs;
    } else if (input.below(4) == 0) {
      bring_up.take(action.bytes, now_ns);
    } else if (!input.empty()) {
      std::array<std::byte, 8> answer{};
      input.fill(answer);
      bring_up.take(answer, now_ns);
    }
  }
  require(false, "the bring-up ends");
}

}  // namespace
}  // namespace tactus::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  tactus::fuzz::FuzzInput input(data, size);
  if (input.take<std::uint8_t>() % 8 == 0) {
    tactus::fuzz::run_upload(input);
  } else {
    tactus::fuzz::run(input);
  }
  return 0;
}
