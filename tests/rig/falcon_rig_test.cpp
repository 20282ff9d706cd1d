// The Falcon's driver at 1 kHz through libusb and two real USB stacks, against the emulated Falcon
// as a gadget. tests/rig/scenarios/usb.sh has set the gadget `falcon` up.
#include "drivers/falcon_usb/falcon.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string_view>
#include <vector>

#include "hal/linux/clock.h"
#include "hal/linux/usb_endpoint.h"
#include "host_tools/emulators/falcon_gadget.h"

namespace tactus::drivers {
namespace {

constexpr hal::TimeNs kRigTick_ns = 1'000'000;
constexpr hal::LinuxUsbConfig kFalconUsb{.vendor = kFalconVendor,
                                         .product = kFalconProduct,
                                         .serial = {},
                                         .interface = 0,
                                         .endpoint_out = kFalconEndpointOut,
                                         .endpoint_in = kFalconEndpointIn};

class FalconOnTheBus : public ::testing::Test {
 protected:
  FalconOnTheBus() {
    clock_.sleep_until(clock_.now_ns() + 200'000'000);  // until the last test's device is forgotten
    gadget_.plug_in();
    open();
    driver_.start();
    wake_ = clock_.sleep_until(clock_.now_ns());
  }

  void open() {
    auto opened = endpoint_.open(kFalconUsb);
    for (int i = 0; !opened && i < 200; ++i) {
      clock_.sleep_until(clock_.now_ns() + 10'000'000);
      opened = endpoint_.reopen();
    }
    ASSERT_TRUE(opened) << hal::words(opened.error().code);
  }
  void move_arms(double angle_rad) {
    gadget_.with_emulator([angle_rad](host::FalconEmulator& falcon) {
      for (host::EmulatedShaft& shaft : falcon.shafts()) {
        shaft.position_rad = angle_rad;
      }
    });
  }
  void tick() {
    const hal::TimeNs start_ns = clock_.now_ns();
    driver_.read(samples_, start_ns + 700'000);
    slowest_read_ns_ = std::max(slowest_read_ns_, clock_.now_ns() - start_ns);
    driver_.write(commands_);
    wake_ = clock_.sleep_to_phase({.period_ns = kRigTick_ns, .offset_ns = 0}, wake_);
  }
  void command(double torque_Nm) {
    for (AxisCommand& axis : commands_) {
      axis.torque_Nm = torque_Nm;
      axis.enable = true;
    }
  }
  bool tick_until(std::uint32_t status, int count) {
    for (int i = 0; i < count && samples_[0].status != status; ++i) {
      tick();
    }
    return samples_[0].status == status;
  }
  // Moves the arms as a user does for homing: out beyond one radian, then in.
  void home() {
    for (int i = 0; i < 1400; ++i) {
      move_arms(0.5 + (i < 700 ? 0.001 * i : 0.001 * (1400 - i)));
      tick();
    }
  }
  std::array<std::int16_t, 3> motors() {
    return gadget_.with_emulator([](host::FalconEmulator& falcon) { return falcon.motors(); });
  }

  std::vector<std::byte> image_ = std::vector<std::byte>(1000, std::byte{0x3C});
  hal::LinuxClock clock_;
  host::FalconGadget gadget_{
      {.firmware_loaded = false, .image_bytes = 1000},
      1,
      {.function_fs = "/dev/ffs/falcon", .gadget = "/sys/kernel/config/usb_gadget/falcon"}};
  hal::LinuxUsbEndpoint endpoint_;
  Falcon driver_{endpoint_, clock_, {.firmware = image_, .unproven_watchdog = true}};
  std::array<AxisSample, kFalconArms> samples_{};
  std::array<AxisCommand, kFalconArms> commands_{};
  hal::TimeNs slowest_read_ns_ = 0;
  hal::Wake wake_;
};

TEST_F(FalconOnTheBus, IsLoadedHomedAndServedAtOneKilohertz) {
  const hal::TimeNs begun_ns = clock_.now_ns();
  ASSERT_TRUE(tick_until(kDeviceHoming, 20'000)) << driver_.trouble(0).what;
  std::printf("measured: Falcon up %.0f ms after start, 1000 bytes of firmware among it\n",
              static_cast<double>(clock_.now_ns() - begun_ns) * 1e-6);
  EXPECT_EQ(gadget_.with_emulator([](host::FalconEmulator& falcon) { return falcon.image(); }),
            image_);
  home();
  ASSERT_TRUE(tick_until(kDeviceOk, 100)) << driver_.trouble(0).what;

  slowest_read_ns_ = 0;
  hal::TimeNs oldest_ns = 0;
  int stale = 0;
  double largest_error_rad = 0.0;
  for (int i = 0; i < 2000; ++i) {
    const double angle_rad = 0.5 + 0.2 * std::sin(0.01 * i);
    move_arms(angle_rad);
    command(0.1 * std::sin(0.01 * i));
    tick();
    stale += samples_[0].status == kDeviceOk ? 0 : 1;
    oldest_ns = std::max(oldest_ns, clock_.now_ns() - samples_[0].time_ns);
    largest_error_rad = std::max(largest_error_rad, std::abs(samples_[0].position_rad - angle_rad));
  }
  std::printf(
      "measured: Falcon 2000 ticks at 1 kHz, %d stale, slowest read %.0f us, oldest sample "
      "%.0f us, angle within %.4f rad\n",
      stale, static_cast<double>(slowest_read_ns_) * 1e-3, static_cast<double>(oldest_ns) * 1e-3,
      largest_error_rad);
  EXPECT_EQ(stale, 0);
  EXPECT_LT(largest_error_rad, 0.01);  // two ticks at 2 rad/s, and a count
  EXPECT_NEAR(motors()[0], -1000.0 * std::sin(0.01 * 1999), 12.0);
}

TEST_F(FalconOnTheBus, PulledPlugEndsInZeroTorqueAndALatchedFault) {
  ASSERT_TRUE(tick_until(kDeviceHoming, 20'000));
  home();
  ASSERT_TRUE(tick_until(kDeviceOk, 100));
  command(0.1);
  for (int i = 0; i < 20; ++i) {
    tick();
  }
  ASSERT_EQ(motors()[0], -1000);
  const hal::TimeNs pulled_ns = clock_.now_ns();
  gadget_.unplug();
  for (int i = 0; i < 50 && (samples_[0].status & kDeviceLost) == 0; ++i) {
    tick();
  }
  const std::string_view what = driver_.trouble(0).what;
  std::printf("measured: Falcon lost %.1f ms after its plug was pulled: %.*s\n",
              static_cast<double>(clock_.now_ns() - pulled_ns) * 1e-6,
              static_cast<int>(what.size()), what.data());
  EXPECT_NE(samples_[0].status & kDeviceLost, 0U);
  EXPECT_EQ(driver_.motors(), (std::array<std::int16_t, 3>{}));
  for (int i = 0; i < 100; ++i) {
    tick();
  }
  EXPECT_EQ(driver_.trouble(0).what, "the Falcon is unplugged");

  gadget_.plug_in();
  for (int i = 0; i < 2000 && endpoint_.state() != hal::UsbState::returned; ++i) {
    tick();
  }
  EXPECT_NE(samples_[0].status & kDeviceLost, 0U);  // latched
  EXPECT_EQ(motors(), (std::array<std::int16_t, 3>{}));
  driver_.clear_faults();
  EXPECT_TRUE(tick_until(kDeviceHoming | kDeviceReferenceLost, 20'000))
      << driver_.trouble(0).what << ", status " << samples_[0].status;
}

TEST_F(FalconOnTheBus, SilentDeviceIsLost) {
  ASSERT_TRUE(tick_until(kDeviceHoming, 20'000));
  home();
  ASSERT_TRUE(tick_until(kDeviceOk, 100));
  gadget_.with_emulator(
      [](host::FalconEmulator& falcon) { falcon.set_fault(host::EmulatorFault::silent); });
  for (int i = 0; i < 10; ++i) {
    tick();
  }
  EXPECT_NE(samples_[0].status & kDeviceLost, 0U);
  EXPECT_EQ(motors(), (std::array<std::int16_t, 3>{}));
}

}  // namespace
}  // namespace tactus::drivers
