// The contract of SerialPort on a real tty: the kernel's cdc-acm here, its ACM gadget at the other
// end. tests/rig/scenarios/usb.sh has set the gadget `haply` up.
#include "hal/linux/serial_port.h"

#include <filesystem>

#include "hal/linux/clock.h"
#include "tests/rig/gadget_switch.h"
#include "tests/unit/hal/serial_port_contract.h"

namespace tactus::hal {
namespace {

constexpr const char* kAcmNode = "/dev/ttyACM0";

class AcmRig {
 public:
  AcmRig() {
    unplug();
    plug_in();
    EXPECT_TRUE(port_.open(kAcmNode, 115200));
  }

  AcmRig(const AcmRig&) = delete;
  AcmRig& operator=(const AcmRig&) = delete;
  ~AcmRig() { unplug(); }  // before the port is closed, which would wait for what was not sent

  SerialPort& port() { return port_; }
  Clock& clock() { return clock_; }
  void answer(std::span<const std::byte> bytes) {
    EXPECT_EQ(device_.write(bytes, clock_.now_ns() + 100'000'000), bytes.size());
  }
  std::size_t hear(std::span<std::byte> buffer) {
    return device_.read(buffer, kNoWait).value_or(0U);
  }
  void unplug() {
    plug_.unplug();
    wait_for_node(false);
  }
  void plug_in() {
    plug_.plug_in();
    wait_for_node(true);
    EXPECT_TRUE(device_.open("/dev/ttyGS0", 115200));
  }

 private:
  void wait_for_node(bool there) {
    for (int i = 0; std::filesystem::exists(kAcmNode) != there && i < 300; ++i) {
      clock_.sleep_until(clock_.now_ns() + 10'000'000);
    }
    clock_.sleep_until(clock_.now_ns() + 50'000'000);  // and until udev has dealt with it
  }

  LinuxClock clock_;
  rig::GadgetSwitch plug_{"haply"};
  LinuxSerialPort device_;
  LinuxSerialPort port_;
};

INSTANTIATE_TYPED_TEST_SUITE_P(Acm, SerialPortContract, AcmRig);

}  // namespace
}  // namespace tactus::hal
