// The contract of UsbEndpoint through libusb and two real USB stacks, dummy_hcd between them,
// against a device that echoes. tests/rig/scenarios/usb.sh has set the gadget `echo` up.
#include "hal/linux/usb_endpoint.h"

#include <unistd.h>

#include <deque>
#include <filesystem>
#include <memory>

#include "hal/linux/clock.h"
#include "host_tools/emulators/function_fs.h"
#include "tests/unit/hal/usb_endpoint_contract.h"

namespace tactus::hal {
namespace {

constexpr LinuxUsbConfig kEchoConfig{.vendor = 0x1D6B, .product = 0x0104};

// The device of the contract.
class EchoDevice final : public host::GadgetDevice {
 public:
  bool control_out(const UsbSetup& setup) override {
    value_ = setup.request == kStore.request ? setup.value : value_;
    return setup.request == kStore.request;
  }
  std::optional<std::vector<std::byte>> control_in(const UsbSetup& setup) override {
    if (setup.request != kFetch.request) {
      return std::nullopt;
    }
    return std::vector{static_cast<std::byte>(value_), static_cast<std::byte>(value_ >> 8U)};
  }
  void bulk_out(TimeNs, std::span<const std::byte> bytes) override {
    waiting_.emplace_back(bytes.begin(), bytes.end());
  }
  TimeNs next_packet_ns() override { return waiting_.empty() || stopped ? kForever : kNoWait; }
  std::vector<std::byte> packet(TimeNs) override {
    auto first = std::move(waiting_.front());
    waiting_.pop_front();
    return first;
  }

  bool stopped = false;

 private:
  std::uint16_t value_ = 0;
  std::deque<std::vector<std::byte>> waiting_;
};

class GadgetRig {
 public:
  GadgetRig() {
    clock_.sleep_until(clock_.now_ns() + 200'000'000);  // until the last test's device is forgotten
    gadget_.plug_in();
    const TimeNs patience_ns = clock_.now_ns() + 2'000'000'000;
    auto opened = endpoint_->open(kEchoConfig);
    while (!opened && clock_.now_ns() < patience_ns) {
      clock_.sleep_until(clock_.now_ns() + 10'000'000);
      opened = endpoint_->reopen();
    }
    EXPECT_TRUE(opened) << words(opened.error().code);
  }

  UsbEndpoint& endpoint() { return *endpoint_; }
  Clock& clock() { return clock_; }
  void unplug() { gadget_.unplug(); }
  void plug_in() {
    gadget_.plug_in();
    wait_for(UsbState::returned);
  }
  void set_stopped(bool stopped) {
    const std::lock_guard lock(gadget_.mutex());
    device_.stopped = stopped;
    gadget_.wake();
  }

 private:
  void wait_for(UsbState state) {
    const TimeNs patience_ns = clock_.now_ns() + 2'000'000'000;
    while (endpoint_->state() != state && clock_.now_ns() < patience_ns) {
      clock_.sleep_until(clock_.now_ns() + 1'000'000);
    }
    EXPECT_EQ(endpoint_->state(), state);
  }

  LinuxClock clock_;
  EchoDevice device_;
  host::FunctionFs gadget_{
      device_, {.function_fs = "/dev/ffs/echo", .gadget = "/sys/kernel/config/usb_gadget/echo"}};
  std::unique_ptr<LinuxUsbEndpoint> endpoint_ = std::make_unique<LinuxUsbEndpoint>();
};

INSTANTIATE_TYPED_TEST_SUITE_P(Libusb, UsbEndpointContract, GadgetRig);

TEST(LinuxUsbEndpoint, SaysThatThereIsNoSuchDevice) {
  LinuxUsbEndpoint endpoint;
  const auto opened = endpoint.open({.vendor = 0x1D6B, .product = 0xFFFF});
  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error().code, ErrorCode::not_found);
  EXPECT_EQ(endpoint.state(), UsbState::detached);
  EXPECT_EQ(endpoint.open(kEchoConfig).error().code, ErrorCode::invalid_state);
}

TEST(LinuxUsbEndpoint, CallsBeforeOpeningSayDisconnected) {
  LinuxUsbEndpoint endpoint;
  std::array<std::byte, 64> buffer;
  EXPECT_EQ(endpoint.bulk_in(buffer, kNoWait).error().code, ErrorCode::disconnected);
  EXPECT_EQ(endpoint.control_out(kStore, {}, kNoWait).error().code, ErrorCode::disconnected);
  EXPECT_EQ(endpoint.reopen().error().code, ErrorCode::disconnected);
  EXPECT_EQ(endpoint.state(), UsbState::detached);
}

TEST(LinuxUsbEndpoint, DeviceClaimedByAnotherIsBusy) {
  GadgetRig rig;
  LinuxUsbEndpoint second;
  EXPECT_EQ(second.open(kEchoConfig).error().code, ErrorCode::busy);
}

TEST(LinuxUsbEndpoint, DeviceWithoutPermissionIsNotPermitted) {
  const GadgetRig rig;
  for (const auto& node : std::filesystem::recursive_directory_iterator("/dev/bus/usb")) {
    if (!node.is_directory()) {
      std::filesystem::permissions(node, std::filesystem::perms::owner_read);
    }
  }
  ASSERT_EQ(seteuid(65534), 0);
  {
    LinuxUsbEndpoint second;
    EXPECT_EQ(second.open(kEchoConfig).error().code, ErrorCode::not_permitted);
  }
  ASSERT_EQ(seteuid(0), 0);
}

TEST(LinuxUsbEndpoint, DeviceIsFoundByItsSerialNumber) {
  GadgetRig rig;
  LinuxUsbEndpoint second;
  LinuxUsbConfig config = kEchoConfig;
  config.serial = "echo-1";
  EXPECT_EQ(second.open(config).error().code, ErrorCode::busy);  // found, and claimed by the rig
}

TEST(LinuxUsbEndpoint, DeviceWithAnotherSerialNumberIsNotOurs) {
  GadgetRig rig;
  LinuxUsbEndpoint other;
  LinuxUsbConfig config = kEchoConfig;
  config.serial = "another";
  EXPECT_EQ(other.open(config).error().code, ErrorCode::not_found);
}

}  // namespace
}  // namespace tactus::hal
