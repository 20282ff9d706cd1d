// The Haply board's driver at 1 kHz through the kernel's CDC-ACM driver, against the emulated board
// behind an ACM gadget. tests/rig/scenarios/usb.sh has set the gadget `haply` up.
#include "drivers/haply_serial/haply.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <mutex>
#include <numbers>
#include <string_view>
#include <thread>

#include "hal/linux/clock.h"
#include "hal/linux/serial_port.h"
#include "host_tools/emulators/haply_emulator.h"
#include "tests/rig/gadget_switch.h"

namespace tactus::drivers {
namespace {

constexpr hal::TimeNs kHaplyRigTick_ns = 1'000'000;

// The board: a thread that polls its end of the line as the firmware does.
class BoardThread {
 public:
  BoardThread() {
    EXPECT_TRUE(port_.open("/dev/ttyGS0", 115200));
    emulator_.shafts()[0].position_rad = std::numbers::pi;
    thread_ = std::thread([this] { serve(); });
  }
  BoardThread(const BoardThread&) = delete;
  BoardThread& operator=(const BoardThread&) = delete;
  ~BoardThread() {
    ending_ = true;
    thread_.join();
  }

  template <class Action>
  auto with_emulator(Action action) {
    const std::lock_guard lock(mutex_);
    return action(emulator_);
  }

 private:
  void serve() {
    while (!ending_) {
      {
        const std::lock_guard lock(mutex_);
        emulator_.run(clock_.now_ns());
      }
      clock_.sleep_until(clock_.now_ns() + 50'000);
    }
  }

  hal::LinuxClock clock_;
  hal::LinuxSerialPort port_;
  host::HaplyEmulator emulator_{port_, 1};
  std::mutex mutex_;
  std::atomic<bool> ending_ = false;
  std::thread thread_;
};

HaplyConfig rig_config() {
  HaplyConfig config;
  config.unproven_watchdog = true;
  config.axis[0].home_rad = std::numbers::pi;
  return config;
}

class HaplyOnTheBus : public ::testing::Test {
 protected:
  HaplyOnTheBus() {
    plug_.unplug();
    for (int i = 0; std::filesystem::exists("/dev/ttyACM0") && i < 200; ++i) {
      clock_.sleep_until(clock_.now_ns() + 10'000'000);  // the node of the last time
    }
    plug_.plug_in();
    auto opened = port_.open("/dev/ttyACM0", 115200);
    for (int i = 0; !opened && i < 200; ++i) {
      clock_.sleep_until(clock_.now_ns() + 10'000'000);
      opened = port_.reopen();
    }
    EXPECT_TRUE(opened) << hal::words(opened.error().code);
    driver_.start();
    wake_ = clock_.sleep_until(clock_.now_ns());
  }
  void tick() {
    driver_.read(samples_, clock_.now_ns() + 800'000);
    driver_.write(commands_);
    wake_ = clock_.sleep_to_phase({.period_ns = kHaplyRigTick_ns, .offset_ns = 0}, wake_);
  }
  void command(double torque_Nm) {
    for (AxisCommand& command : commands_) {
      command = {.torque_Nm = torque_Nm, .enable = true};
    }
  }
  bool tick_until(std::uint32_t status, int count) {
    for (int i = 0; i < count && samples_[0].status != status; ++i) {
      tick();
    }
    return samples_[0].status == status;
  }

  rig::GadgetSwitch plug_{"haply"};
  hal::LinuxClock clock_;
  BoardThread board_;
  hal::LinuxSerialPort port_;
  Haply driver_{port_, clock_, rig_config()};
  std::array<AxisSample, kHaplyMaxAxes> samples_{};
  std::array<AxisCommand, kHaplyMaxAxes> commands_{};
  hal::Wake wake_;
};

TEST_F(HaplyOnTheBus, IsServedAtOneKilohertz) {
  ASSERT_TRUE(tick_until(kDeviceOk, 500)) << driver_.trouble(0).what;
  int stale = 0;
  double largest_error_rad = 0.0;
  for (int i = 0; i < 2000; ++i) {
    const double angle_rad = 0.2 * std::sin(0.01 * i);
    board_.with_emulator(
        [angle_rad](host::HaplyEmulator& board) { board.shafts()[1].position_rad = angle_rad; });
    command(0.05 * std::cos(0.01 * i));
    tick();
    stale += samples_[0].status == kDeviceOk ? 0 : 1;
    largest_error_rad = std::max(largest_error_rad, std::abs(samples_[1].position_rad - angle_rad));
  }
  std::printf("measured: Haply 2000 ticks at 1 kHz, %d stale, angle within %.4f rad\n", stale,
              largest_error_rad);
  EXPECT_EQ(stale, 0);
  EXPECT_LT(largest_error_rad, 0.006);
  EXPECT_NEAR(
      board_.with_emulator([](host::HaplyEmulator& board) { return board.shafts()[0].torque_Nm; }),
      0.05 * std::cos(0.01 * 1999), 0.001);
}

TEST_F(HaplyOnTheBus, PulledPlugIsALatchedFault) {
  ASSERT_TRUE(tick_until(kDeviceOk, 500)) << driver_.trouble(0).what;
  const hal::TimeNs pulled_ns = clock_.now_ns();
  plug_.unplug();
  for (int i = 0; i < 100 && (samples_[0].status & kDeviceLost) == 0; ++i) {
    tick();
  }
  const std::string_view what = driver_.trouble(0).what;
  std::printf("measured: Haply lost %.1f ms after its plug was pulled: %.*s\n",
              static_cast<double>(clock_.now_ns() - pulled_ns) * 1e-6,
              static_cast<int>(what.size()), what.data());
  EXPECT_NE(samples_[0].status & kDeviceLost, 0U);
  EXPECT_FALSE(driver_.trouble(0).remedy.empty());
}

}  // namespace
}  // namespace tactus::drivers
