// USB and GPIO in a build without libusb and libgpiod: nothing opens, and the reason is
// `not_supported`.
#include <gtest/gtest.h>

#include <array>

#include "hal/linux/gpio_lines.h"
#include "hal/linux/usb_endpoint.h"

namespace tactus::hal {
namespace {

TEST(AbsentLibraries, AreKnown) {
  EXPECT_FALSE(has_libusb());
  EXPECT_FALSE(has_libgpiod());
}

TEST(AbsentLibraries, NoUsbDeviceOpens) {
  LinuxUsbEndpoint usb;
  const auto opened = usb.open({.vendor = 0x0403, .product = 0xcb48});
  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error().code, ErrorCode::not_supported);
  EXPECT_EQ(usb.state(), UsbState::detached);
}

TEST(AbsentLibraries, NoGpioLineIsHad) {
  LinuxGpioLines lines("/dev/gpiochip0");
  const std::array line{GpioLineConfig{.offset = 3, .direction = GpioDirection::output}};
  const auto requested = lines.request({.lines = line});
  ASSERT_FALSE(requested);
  EXPECT_EQ(requested.error().code, ErrorCode::not_supported);
}

}  // namespace
}  // namespace tactus::hal
