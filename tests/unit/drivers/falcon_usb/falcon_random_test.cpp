// No bytes make the driver call a jump a position, or send torque beyond its limit.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <vector>

#include "drivers/falcon_usb/falcon.h"
#include "hal/simulated/usb_endpoint.h"

namespace tactus::drivers {
namespace {

// A device that says whatever the test puts into it, and remembers what it was told.
class AnyDevice final : public hal::SimulatedUsbPeer {
 public:
  hal::Result<std::size_t> control_out(const hal::UsbSetup&, std::span<const std::byte>) override {
    return std::size_t{0};
  }
  hal::Result<std::size_t> control_in(const hal::UsbSetup&, std::span<std::byte>) override {
    return hal::failure(hal::ErrorCode::stalled);
  }
  void bulk_out(std::span<const std::byte> data) override { last.assign(data.begin(), data.end()); }

  std::vector<std::byte> last;
};

class Mixer {
 public:
  explicit Mixer(std::uint32_t seed) : random_(seed) {}

  // Rubbish, cut packets, packets with wild or with tame counts.
  std::vector<std::byte> packet() {
    std::vector<std::byte> bytes = {std::byte{0x31}, std::byte{0x60}};
    const int parts = number(0, 2);
    for (int i = 0; i < parts; ++i) {
      append_part(bytes);
    }
    bytes.resize(std::min<std::size_t>(bytes.size(), 64));
    return bytes;
  }
  int number(int from, int to) { return std::uniform_int_distribution(from, to)(random_); }

 private:
  void append_part(std::vector<std::byte>& bytes) {
    const int kind = number(0, 9);
    if (kind == 0) {
      for (int i = number(1, 20); i > 0; --i) {
        bytes.push_back(static_cast<std::byte>(number(0, 255)));
      }
      return;
    }
    FalconCommand command;  // the frame is the same both ways
    for (std::int16_t& counts : command.motor) {
      counts = static_cast<std::int16_t>(kind == 1 ? number(-4095, 4095) : number(-30, 30));
    }
    FalconPacket packet = encode(command);
    packet[13] = static_cast<std::byte>('A' + (kind == 2 ? number(0, 127) : 0x70));
    const std::size_t size = kind == 3 ? static_cast<std::size_t>(number(0, 15)) : packet.size();
    bytes.insert(bytes.end(), packet.begin(), packet.begin() + static_cast<std::ptrdiff_t>(size));
  }

  std::mt19937 random_;
};

TEST(FalconRandom, NoBytesMakeAJumpOrTorqueBeyondTheLimit) {
  int good_samples = 0;
  for (std::uint32_t seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE(seed);
    Mixer mixer(seed);
    hal::SimulatedClock clock;
    AnyDevice device;
    hal::SimulatedUsbEndpoint endpoint(clock, device);
    const FalconConfig config{.torque_limit_Nm = 0.1, .unproven_watchdog = true};
    Falcon driver(endpoint, clock, config);
    driver.start();
    std::array<AxisSample, kFalconArms> samples{};
    std::array<AxisSample, kFalconArms> last{};
    bool had_one = false;
    for (int tick = 0; tick < 400; ++tick) {
      for (int i = mixer.number(0, 3) / 2; i >= 0; --i) {
        endpoint.answer(mixer.packet());
      }
      driver.read(samples, clock.now_ns() + 500'000);
      if (samples[0].status == kDeviceOk) {
        ++good_samples;
        for (std::size_t arm = 0; had_one && arm < kFalconArms; ++arm) {
          const double passed_s =
              static_cast<double>(samples[arm].time_ns - last[arm].time_ns) * 1e-9;
          ASSERT_LE(std::abs(samples[arm].position_rad - last[arm].position_rad),
                    config.fastest_rad_per_s * passed_s + 10 * kFalconRadPerCount);
        }
        had_one = true;
        last = samples;
      }
      std::array<AxisCommand, kFalconArms> commands;
      commands.fill({.torque_Nm = mixer.number(-2, 2) * 0.3, .enable = true});
      device.last.clear();
      driver.write(commands);
      if (const auto& sent = device.last; sent.size() == kFalconPacketBytes) {
        const auto motors = decode_falcon_reply(std::span(sent).first<kFalconPacketBytes>());
        ASSERT_TRUE(motors);
        for (const std::int16_t motor : motors->counts) {
          ASSERT_LE(std::abs(int{motor}), 1000);
        }
        if (samples[0].status != kDeviceOk && samples[0].status != kDeviceStale) {
          ASSERT_EQ(motors->counts, (std::array<std::int16_t, 3>{}));
        }
      }
      clock.advance_by(1'000'000);
    }
  }
  EXPECT_GT(good_samples, 100);  // or the test shows nothing
}

}  // namespace
}  // namespace tactus::drivers
