#include "host_tools/emulators/serial_device.h"

#include <gtest/gtest.h>

#include <array>
#include <string>

#include "hal/linux/serial_port.h"
#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

std::size_t poll(SerialDevice& device, std::span<std::byte> room) {
  return device.read(room, hal::kNoWait).value_or(0);
}

TEST(SerialDevice, HandsOutAMessageWholeOnePollAfterItsEnd) {
  SerialDevice device;
  hal::LinuxSerialPort host;
  ASSERT_TRUE(host.open(device.open_pseudo_terminal(), 115200));
  const std::array message = {std::byte{2}, std::byte{5}, std::byte{0x0D}, std::byte{0xFF}};
  std::array<std::byte, 16> room{};
  ASSERT_EQ(host.write(std::span(message).first(1), hal::kNoWait), 1U);
  EXPECT_EQ(poll(device, room), 0U);
  ASSERT_EQ(host.write(std::span(message).subspan(1), hal::kNoWait), 3U);
  EXPECT_EQ(poll(device, room), 0U);
  ASSERT_EQ(poll(device, room), 4U);
  EXPECT_TRUE(std::equal(message.begin(), message.end(), room.begin()));
  EXPECT_EQ(poll(device, room), 0U);

  ASSERT_EQ(device.write(message, hal::kNoWait), 4U);
  EXPECT_EQ(host.read(room, hal::kNoWait).value_or(0), 4U);
}

TEST(SerialDevice, StreamWithoutAPauseIsHandedOutTooAndLosesNothing) {
  SerialDevice device;
  hal::LinuxSerialPort host;
  ASSERT_TRUE(host.open(device.open_pseudo_terminal(), 115200));
  std::size_t received = 0;
  std::array<std::byte, 256> room{};
  const std::array<std::byte, 200> piece{};
  for (int i = 0; i < 100; ++i) {
    ASSERT_EQ(host.write(piece, hal::kNoWait), piece.size());
    received += poll(device, room);
  }
  EXPECT_GT(received, 0U);
  for (int i = 0; i < 200; ++i) {
    received += poll(device, room);
  }
  EXPECT_EQ(received, 100U * piece.size());
}

TEST(SerialDevice, TtyThatIsNotThereIsTheUsersMatter) {
  SerialDevice device;
  EXPECT_THROW(device.open("/nowhere"), InputError);
}

}  // namespace
}  // namespace tactus::host
