// The axis driver and its emulated device, with the kernel in between: the driver on libgpiod and
// on a PWM channel in a folder, at 1 kHz; the emulator and a rotor on gpio-sim's other side, at 10
// kHz. Position against the rotor's, torque against the command, and how long each fault takes to a
// torque of zero. A real board has a real PWM; here its folder stands for it.
#include <gtest/gtest.h>
#include <pthread.h>
#include <sched.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <string_view>
#include <thread>

#include "drivers/gpio_axis/gpio_axis.h"
#include "hal/linux/clock.h"
#include "hal/linux/gpio_lines.h"
#include "hal/linux/pwm_output.h"
#include "host_tools/emulators/gpio_axis_emulator.h"
#include "host_tools/emulators/gpio_sim_pins.h"

namespace tactus::drivers {
namespace {

constexpr const char* kPaddlePwmFolder = "/tmp/gpio_axis_rig_pwm";
constexpr hal::TimeNs kPaddleTick_ns = 1'000'000;
constexpr hal::TimeNs kPlantStep_ns = 100'000;
constexpr double kPaddleCount_rad = 2.0 * std::numbers::pi / 2000.0;

GpioAxisConfig paddle_config() {
  GpioAxisConfig config;
  config.encoder = {.counts_per_rev = 2000, .max_speed_rad_per_s = 15.0, .silence_ms = 100};
  config.bridge = {
      .law = TorqueLaw::square_root, .full_duty_torque_Nm = 0.03, .max_torque_Nm = 0.02};
  config.pins.encoder_a = InputPin{.offset = 0};
  config.pins.encoder_b = InputPin{.offset = 1};
  config.pins.encoder_index = InputPin{.offset = 2};
  config.pins.fault = InputPin{.offset = 3, .active_low = true};
  config.pins.emergency_stop = InputPin{.offset = 4};
  config.pins.limit_low = InputPin{.offset = 5};
  config.pins.limit_high = InputPin{.offset = 6};
  config.pins.direction = OutputPin{.offset = 7};
  config.pins.enable = OutputPin{.offset = 8};
  config.pins.brake_release = OutputPin{.offset = 9};
  config.pins.heartbeat = OutputPin{.offset = 10};
  config.torque_ramp_ms = 0;
  return config;
}

void run_with(int policy, int priority) {
  const sched_param wanted{.sched_priority = priority};
  ASSERT_EQ(::pthread_setschedparam(::pthread_self(), policy, &wanted), 0);
}

// A rotor on the emulated motor, in a thread of its own below the interrupts.
class EmulatedRotor {
 public:
  explicit EmulatedRotor(const GpioAxisConfig& config)
      : emulator_(config, pins_, 1), thread_([this] { run(); }) {}
  EmulatedRotor(const EmulatedRotor&) = delete;
  EmulatedRotor& operator=(const EmulatedRotor&) = delete;
  ~EmulatedRotor() {
    stop_.store(true);
    thread_.join();
  }

  [[nodiscard]] double position_rad() const { return position_rad_.load(); }
  [[nodiscard]] double torque_Nm() const { return torque_Nm_.load(); }
  [[nodiscard]] double pwm_level() { return pins_.pwm_level(); }
  void set_fault(host::EmulatorFault fault) { fault_.store(fault); }
  void open_emergency_stop() { opens_chain_.store(true); }

 private:
  static constexpr double kInertia_kg_m2 = 2e-5;
  static constexpr double kDamping_Nms = 2e-4;

  void run() {
    run_with(SCHED_FIFO, 40);
    hal::LinuxClock clock;
    hal::Wake wake = clock.sleep_until(clock.now_ns());
    while (!stop_.load()) {
      wake = clock.sleep_to_phase({.period_ns = kPlantStep_ns}, wake);
      emulator_.set_fault(fault_.load());
      if (opens_chain_.exchange(false)) {
        emulator_.open_emergency_stop(true);
      }
      turn(1e-9 * static_cast<double>(kPlantStep_ns * (1 + wake.skipped)));
      emulator_.run(clock.now_ns());
      position_rad_.store(emulator_.shaft().position_rad);
      torque_Nm_.store(emulator_.shaft().torque_Nm);
    }
  }
  void turn(double step_s) {
    host::EmulatedShaft& shaft = emulator_.shaft();
    shaft.velocity_rad_per_s +=
        step_s * (shaft.torque_Nm - kDamping_Nms * shaft.velocity_rad_per_s) / kInertia_kg_m2;
    shaft.position_rad += step_s * shaft.velocity_rad_per_s;
  }

  host::GpioSimPins pins_{"paddle", "paddle-lines", 12, kPaddlePwmFolder};
  host::GpioAxisEmulator emulator_;
  std::atomic<double> position_rad_ = 0.0;
  std::atomic<double> torque_Nm_ = 0.0;
  std::atomic<host::EmulatorFault> fault_ = host::EmulatorFault::none;
  std::atomic<bool> opens_chain_ = false;
  std::atomic<bool> stop_ = false;
  std::thread thread_;
};

class GpioAxisRig : public ::testing::Test {
 public:
  GpioAxisRig(const GpioAxisRig&) = delete;
  GpioAxisRig& operator=(const GpioAxisRig&) = delete;

 protected:
  GpioAxisRig() {
    EXPECT_TRUE(pwm_.open("pwmchip0", 0, kPaddlePwmFolder));
    run_with(SCHED_FIFO, 80);
    clock_.sleep_until(clock_.now_ns() + 20 * kPaddleTick_ns);
    axis_.start();
    wake_ = clock_.sleep_until(clock_.now_ns());
    for (int i = 0; i < 300; ++i) {
      tick(swing());
    }
    EXPECT_EQ(sample_.status, kDeviceOk) << axis_.trouble(0).what;
  }
  ~GpioAxisRig() override {
    axis_.stop();
    run_with(SCHED_OTHER, 0);
  }

  void tick(double torque_Nm) {
    wake_ = clock_.sleep_to_phase({.period_ns = kPaddleTick_ns}, wake_);
    axis_.read(std::span(&sample_, 1), hal::kNoWait);
    true_rad_ = rotor_.position_rad();
    delivered_Nm_ = rotor_.torque_Nm();
    const AxisCommand command{.torque_Nm = torque_Nm, .enable = true};
    axis_.write(std::span(&command, 1));
  }
  // A damped spring to a target that swings once in 0.4 s.
  double swing() {
    const double target_rad = 0.4 * std::sin(5.0 * std::numbers::pi * 1e-3 * ticks_++);
    commanded_Nm_ =
        std::clamp(0.05 * (target_rad - sample_.position_rad) - 0.001 * sample_.velocity_rad_per_s,
                   -0.02, 0.02);
    return commanded_Nm_;
  }
  // Returns the time from a fault to the motor's torque of zero, by the controller's clock. The
  // push goes on meanwhile.
  double time_to_zero_ms(double push_Nm) {
    const hal::TimeNs start_ns = clock_.now_ns();
    for (int i = 0; i < 400; ++i) {
      tick(push_Nm);
      if (sample_.status != kDeviceOk && rotor_.torque_Nm() == 0.0) {
        break;
      }
    }
    return 1e-6 * static_cast<double>(clock_.now_ns() - start_ns);
  }
  void expect_zero_torque_for_good(std::uint32_t status, GpioAxisTrouble trouble) {
    EXPECT_NE(sample_.status & status, 0U);
    EXPECT_EQ(axis_.trouble(0).code, static_cast<std::uint32_t>(trouble)) << axis_.trouble(0).what;
    EXPECT_FALSE(axis_.trouble(0).remedy.empty());
    for (int i = 0; i < 50; ++i) {
      tick(0.02);
      EXPECT_EQ(rotor_.torque_Nm(), 0.0);
    }
    EXPECT_EQ(rotor_.pwm_level(), 0.0);
  }

  const GpioAxisConfig config_ = paddle_config();
  EmulatedRotor rotor_{config_};
  hal::LinuxClock clock_;
  hal::LinuxGpioLines lines_{"paddle-lines"};
  hal::LinuxPwmOutput pwm_;
  GpioAxis axis_{config_, lines_, pwm_, clock_};
  hal::Wake wake_;
  AxisSample sample_;
  double true_rad_ = 0.0;      // the rotor's, when the axis was read
  double delivered_Nm_ = 0.0;  // the motor's, by the last command
  double commanded_Nm_ = 0.0;
  int ticks_ = 0;
};

TEST_F(GpioAxisRig, PositionFollowsTheRotorAndTorqueTheCommand) {
  double worst_counts = 0.0;
  double worst_Nm = 0.0;
  for (int i = 0; i < 2000; ++i) {
    const double last_Nm = commanded_Nm_;
    const double wanted_Nm = swing();
    tick(wanted_Nm);
    ASSERT_EQ(sample_.status, kDeviceOk) << axis_.trouble(0).what;
    worst_counts =
        std::max(worst_counts, std::abs(sample_.position_rad - true_rad_) / kPaddleCount_rad);
    worst_Nm = std::max(worst_Nm, std::abs(delivered_Nm_ - last_Nm));
  }
  std::printf(
      "measured: paddle on GPIO at 1 kHz: position within %.1f counts, torque within %.6f N m\n",
      worst_counts, worst_Nm);
  EXPECT_LT(worst_counts, 4.0);
  EXPECT_LT(worst_Nm, 0.003);
}

struct RigFault {
  const char* name;
  host::EmulatorFault fault;
  std::uint32_t status;
  GpioAxisTrouble trouble;
  double push_Nm;  // all the while
  double within_ms;
};

class GpioAxisRigFaults : public GpioAxisRig, public ::testing::WithParamInterface<RigFault> {};

TEST_P(GpioAxisRigFaults, EndsInZeroTorqueAndSaysWhatToDo) {
  rotor_.set_fault(GetParam().fault);
  const double took_ms = time_to_zero_ms(GetParam().push_Nm);
  const std::string_view what = axis_.trouble(0).what;
  std::printf("measured: paddle on GPIO: %s to zero torque in %.1f ms: %.*s\n", GetParam().name,
              took_ms, static_cast<int>(what.size()), what.data());
  EXPECT_LE(took_ms, GetParam().within_ms);
  expect_zero_torque_for_good(GetParam().status, GetParam().trouble);
}

// The time of a chip that goes is mostly the kernel's, which takes gpio-sim apart; the emulated
// glitch comes once in 50 of its runs, 5 ms, in the mean; silence_ms is 100 here.
INSTANTIATE_TEST_SUITE_P(
    Emulated, GpioAxisRigFaults,
    ::testing::Values(RigFault{"bridge fault", host::EmulatorFault::erroring, kDeviceDriveFault,
                               GpioAxisTrouble::bridge_fault, 0.02, 5.0},
                      RigFault{"chip gone", host::EmulatorFault::unplugged, kDeviceLost,
                               GpioAxisTrouble::lines_gone, 0.02, 20.0},
                      RigFault{"silent encoder", host::EmulatorFault::silent, kDeviceEncoderFault,
                               GpioAxisTrouble::silent, 0.02, 110.0},
                      RigFault{"corrupted encoder", host::EmulatorFault::corrupted,
                               kDeviceEncoderFault, GpioAxisTrouble::illegal_transition, 0.001,
                               60.0}),
    [](const auto& fault) { return std::string("Fault") + std::to_string(fault.index); });

TEST_F(GpioAxisRig, EmergencyStopEndsInZeroTorque) {
  rotor_.open_emergency_stop();
  std::printf("measured: paddle on GPIO: emergency stop to zero torque in %.1f ms\n",
              time_to_zero_ms(0.02));
  expect_zero_torque_for_good(kDeviceEmergencyStop, GpioAxisTrouble::emergency_stop);
}

TEST_F(GpioAxisRig, AHungControllerLosesTheMotorByTheHeartbeat) {
  for (int i = 0; i < 5; ++i) {
    tick(0.005);
  }
  EXPECT_GT(rotor_.torque_Nm(), 0.0);
  clock_.sleep_until(clock_.now_ns() + 15 * kPaddleTick_ns);
  EXPECT_EQ(rotor_.torque_Nm(), 0.0);
}

}  // namespace
}  // namespace tactus::drivers
