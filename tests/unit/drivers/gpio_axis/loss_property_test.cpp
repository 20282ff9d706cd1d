// Random edge streams with everything that can happen to them. Whatever happens, a position that is
// reported as valid is the true one, and the torque is within its limit.
#include <cmath>
#include <numbers>

#include "tests/unit/drivers/gpio_axis/axis_bench.h"
#include "tests/unit/hal/random.h"

namespace tactus::drivers {
namespace {

GpioAxisConfig bare_config() {
  GpioAxisConfig config = full_config();
  config.pins.encoder_index.reset();
  config.edge_buffer = 16;  // soon full
  return config;
}

// Drives the channels itself, edge by edge, as fast as it likes.
class EdgeStream {
 public:
  EdgeStream(AxisBench& bench, hal::Random& random) : bench_(bench), random_(random) {}

  void step(int direction, hal::TimeNs after_ns) {
    bench_.clock.advance_by(after_ns);
    position_ += direction;
    show();
  }
  // Changes both channels in the same instant.
  void skip() {
    bench_.clock.advance_by(40'000);
    position_ += 2;
    show();
  }
  void start_again() { position_ = 0; }
  [[nodiscard]] std::int64_t position() const { return position_; }
  int direction() { return random_.one_in(4) ? -1 : 1; }

 private:
  void show() {
    const auto quarter = static_cast<std::uint64_t>(position_ + offset_) % 4U;
    bench_.chip.drive(7, quarter == 1 || quarter == 2);
    bench_.chip.drive(3, quarter == 2 || quarter == 3);
  }
  AxisBench& bench_;
  hal::Random& random_;
  std::int64_t position_ = 0;
  std::int64_t offset_ = 0;
};

TEST(GpioAxisProperty, APositionReportedAsValidIsTheTrueOne) {
  hal::Random random(20261122);
  int faults = 0;
  int valid = 0;
  for (int run = 0; run < 400; ++run) {
    AxisBench bench(bare_config());
    EdgeStream stream(bench, random);
    for (int tick = 0; tick < 40; ++tick) {
      const bool bursts = random.one_in(120);
      const std::size_t steps = bursts ? 17 + random.below(20) : random.below(12);
      for (std::size_t i = 0; i < steps; ++i) {
        if (random.one_in(1500)) {
          bench.lines.lose_next_edges(static_cast<std::uint32_t>(1 + random.below(5)));
        }
        if (random.one_in(3000)) {
          stream.skip();
        } else {
          stream.step(stream.direction(), 40'000);
        }
      }
      // The kernel always reports the last edge: a gap never stays unseen.
      bench.lines.lose_next_edges(0);
      stream.step(1, 40'000);
      const AxisCommand wild{.torque_Nm = 0.1 * (static_cast<double>(random.below(100)) - 50.0),
                             .enable = !random.one_in(10)};
      bench.axis.read(std::span(&bench.sample, 1), hal::kNoWait);
      bench.axis.write(std::span(&wild, 1));
      bench.emulator.set_fault(host::EmulatorFault::silent);  // the stream has the channels
      bench.emulator.run(bench.clock.now_ns());
      ASSERT_LE(std::abs(bench.torque()), 0.04 + 1e-12);
      if (bench.sample.status != kDeviceOk) {
        ASSERT_EQ(bench.torque(), 0.0);
        ASSERT_TRUE(bench.axis.trouble(0));
        ++faults;
        break;
      }
      ++valid;
      ASSERT_NEAR(bench.sample.position_rad / kCount_rad, static_cast<double>(stream.position()),
                  1e-6)
          << "seed " << random.seed() << ", run " << run << ", tick " << tick;
    }
  }
  EXPECT_GT(faults, 100);
  EXPECT_GT(valid, 2000);
}

TEST(GpioAxisProperty, AfterAResetThePositionIsTrueAgainFromZero) {
  hal::Random random(4);
  AxisBench bench(bare_config());
  EdgeStream stream(bench, random);
  std::int64_t origin = 0;
  int resets = 0;
  for (int tick = 0; tick < 20'000; ++tick) {
    for (std::size_t i = random.below(10); i > 0; --i) {
      if (random.one_in(500)) {
        bench.lines.lose_next_edges(1);
      }
      stream.step(stream.direction(), 40'000);
    }
    bench.lines.lose_next_edges(0);
    stream.step(-1, 40'000);
    bench.axis.read(std::span(&bench.sample, 1), hal::kNoWait);
    if (bench.sample.status != kDeviceOk) {
      bench.axis.clear_faults();
      origin = stream.position();
      ++resets;
      continue;
    }
    ASSERT_NEAR(bench.sample.position_rad / kCount_rad,
                static_cast<double>(stream.position() - origin), 1e-6)
        << "seed " << random.seed() << ", tick " << tick;
  }
  EXPECT_GT(resets, 50);
}

}  // namespace
}  // namespace tactus::drivers
