// An encoder on gpio-sim, faster and faster, read by the driver at 1 kHz: how many edges a second
// come through, and whether every loss becomes a fault and never a position.
//
// The machine has one processor. The driver runs as a controller would, above the kernel's
// interrupt threads (SCHED_FIFO 50); the encoder below them, as a shaft takes no processor time, or
// above, where it starves them.
#include <pthread.h>
#include <sched.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <thread>

#include "drivers/gpio_axis/gpio_axis.h"
#include "hal/linux/clock.h"
#include "hal/linux/gpio_lines.h"
#include "hal/linux/pwm_output.h"
#include "host_tools/emulators/gpio_sim_pins.h"

#include <gtest/gtest.h>

namespace tactus::drivers {
namespace {

constexpr const char* kRatePwmFolder = "/tmp/quadrature_rate_rig_pwm";
constexpr std::uint32_t kCountsPerRev = 2000;
constexpr double kCount_rad = 2.0 * std::numbers::pi / kCountsPerRev;
constexpr hal::TimeNs kRateTick_ns = 1'000'000;
constexpr double kLate_s = 100e-6;

GpioAxisConfig rate_config() {
  GpioAxisConfig config;
  config.encoder = {.counts_per_rev = kCountsPerRev, .max_speed_rad_per_s = 20'000.0 * kCount_rad};
  config.bridge = {.full_duty_torque_Nm = 0.05, .max_torque_Nm = 0.05};
  config.pins.encoder_a = InputPin{.offset = 0};
  config.pins.encoder_b = InputPin{.offset = 1};
  config.pins.direction = OutputPin{.offset = 2};
  config.pins.enable = OutputPin{.offset = 3};
  return config;
}

void run_at_priority(int priority) {
  const sched_param wanted{.sched_priority = priority};
  ASSERT_EQ(::pthread_setschedparam(::pthread_self(), SCHED_FIFO, &wanted), 0);
}

// Turns forward at a steady rate, each edge at its own time.
class Shaft {
 public:
  // `phase` is where the last shaft on these pins stood, in edges.
  Shaft(host::GpioSimPins& pins, int phase, int priority, double edges_per_s, int edges)
      : thread_([&pins, phase, priority, edges_per_s, edges, this] {
          run_at_priority(priority);
          hal::LinuxClock clock;
          const hal::TimeNs start_ns = clock.now_ns() + kRateTick_ns;
          for (int i = 1; i <= edges; ++i) {
            clock.sleep_until(start_ns + static_cast<hal::TimeNs>(1e9 * i / edges_per_s));
            const unsigned quarter = static_cast<unsigned>(phase + i) % 4U;
            const bool moves_a = quarter == 1 || quarter == 3;
            pins.drive(moves_a ? 0 : 1, quarter == 1 || quarter == 2);
            count_.store(i);
          }
          rate_.store(1e9 * edges / static_cast<double>(clock.now_ns() - start_ns));
          done_.store(true);
        }) {}
  Shaft(const Shaft&) = delete;
  Shaft& operator=(const Shaft&) = delete;
  ~Shaft() { thread_.join(); }

  [[nodiscard]] int count() const { return count_.load(); }
  [[nodiscard]] bool done() const { return done_.load(); }
  // Returns the rate that was reached, edges a second. It is lower than asked for if the thread
  // waits for the interrupts.
  [[nodiscard]] double rate() const { return rate_.load(); }

 private:
  std::atomic<int> count_ = 0;
  std::atomic<bool> done_ = false;
  std::atomic<double> rate_ = 0.0;
  std::thread thread_;
};

class QuadratureRate : public ::testing::Test {
 public:
  QuadratureRate(const QuadratureRate&) = delete;
  QuadratureRate& operator=(const QuadratureRate&) = delete;

 protected:
  QuadratureRate() {
    EXPECT_TRUE(pwm_.open("pwmchip0", 0, kRatePwmFolder));
    run_at_priority(80);
  }
  ~QuadratureRate() override {
    const sched_param ordinary{.sched_priority = 0};
    ::pthread_setschedparam(::pthread_self(), SCHED_OTHER, &ordinary);
  }

  // Turns a number of edges and reads until well after the last. True when the
  // driver reported a fault; if it did not, every position was the true one.
  bool turn(int priority, double edges_per_s, int edges) {
    axis_.start();
    axis_.read(std::span(&sample_, 1), hal::kNoWait);
    EXPECT_EQ(sample_.status, kDeviceOk) << axis_.trouble(0).what;
    Shaft shaft(pins_, phase_, priority, edges_per_s, edges);
    phase_ += edges;
    hal::Wake wake = clock_.sleep_until(clock_.now_ns());
    for (int after = 0; after < 20; after += shaft.done() ? 1 : 0) {
      wake = clock_.sleep_to_phase({.period_ns = kRateTick_ns}, wake);
      const int before = shaft.count();
      axis_.read(std::span(&sample_, 1), hal::kNoWait);
      if (sample_.status == kDeviceOk) {
        // Interrupts that wait while the driver reads are late by no more than this.
        const double late = 4.0 + edges_per_s * kLate_s;
        expect_position_between(before - late, shaft.count());
      }
    }
    rate_ = shaft.rate();
    if (sample_.status == kDeviceOk) {
      EXPECT_EQ(std::lround(sample_.position_rad / kCount_rad), edges) << "and said to be well";
      return false;
    }
    EXPECT_EQ(sample_.status, kDeviceEncoderFault | kDeviceReferenceLost) << axis_.trouble(0).what;
    EXPECT_TRUE(axis_.trouble(0));
    return true;
  }
  void expect_position_between(double low, double high) const {
    const double count = sample_.position_rad / kCount_rad;
    EXPECT_GE(count, low - 1e-6);
    EXPECT_LE(count, high + 1.0 + 1e-6);
  }

  host::GpioSimPins pins_{"quadrature", "quadrature-lines", 8, kRatePwmFolder};
  hal::LinuxClock clock_;
  hal::LinuxGpioLines lines_{"quadrature-lines"};
  hal::LinuxPwmOutput pwm_;
  GpioAxis axis_{rate_config(), lines_, pwm_, clock_};
  AxisSample sample_;
  int phase_ = 0;
  double rate_ = 0.0;  // of the last turn
};

TEST_F(QuadratureRate, EveryLossIsAFaultAndNeverAPosition) {
  double lossless = 0.0;
  bool lost = false;
  for (const double rate :
       {1e3, 2e3, 5e3, 10e3, 12e3, 14e3, 16e3, 18e3, 20e3, 22e3, 25e3, 30e3, 40e3}) {
    const bool fault = turn(40, rate, static_cast<int>(rate / 4.0));
    std::printf("measured: %6.0f edges/s from below the interrupts: %s\n", rate_,
                fault ? axis_.trouble(0).what.data() : "every edge");
    lost = lost || fault;
    lossless = lost ? lossless : std::max(lossless, rate_);
  }
  std::printf("measured: lossless up to %.0f edges/s\n", lossless);
  EXPECT_GE(lossless, 9e3);
}

TEST_F(QuadratureRate, AStarvedInterruptIsAFaultAndNeverAPosition) {
  int faults = 0;
  for (const double rate : {1e3, 4e3, 8e3, 10e3, 12.5e3, 14e3, 20e3, 50e3}) {
    const bool fault = turn(60, rate, static_cast<int>(rate / 4.0));
    std::printf("measured: %6.0f edges/s from above the interrupts: %s\n", rate_,
                fault ? axis_.trouble(0).what.data() : "every edge");
    faults += fault ? 1 : 0;
  }
  EXPECT_GT(faults, 0);
}

// Interrupts that ran together leave no gap in the numbers. After 4 k + 2 edges the levels stand as
// after two, with one edge of each channel left to report: the hardest case.
TEST_F(QuadratureRate, BurstsOfAnyLengthAreAFaultOrTheTruth) {
  constexpr int kBursts = 40;
  int faults = 0;
  for (int edges = 1; edges <= kBursts; ++edges) {
    faults += turn(60, 1e6, edges) ? 1 : 0;
  }
  std::printf("measured: %d of %d bursts at 1e6 edges/s were faults, none a wrong position\n",
              faults, kBursts);
}

}  // namespace
}  // namespace tactus::drivers
