// libgpiod 2 in the emulated machine: the contract on a chip of the kernel's gpio-sim, then every
// error that the interface documents, the chip's removal, and the heap between request and release.
#include "hal/linux/gpio_lines.h"

#include <memory>

#include "hal/linux/clock.h"
#include "host_tools/emulators/gpio_sim_pins.h"
#include "tests/support/heap_trap.h"
#include "tests/unit/hal/gpio_lines_contract.h"

namespace tactus::hal {
namespace {

constexpr const char* kLinesPwmFolder = "/tmp/gpio_lines_rig_pwm";
constexpr TimeNs kServed_ns = 500'000;  // from a level to its interrupt's end, amply

struct GpioSimRig {
  GpioLines& lines() { return first; }
  GpioLines& other_lines() { return second; }
  Clock& clock() { return time; }
  void drive(std::size_t offset, bool high) {
    pins.drive(static_cast<std::uint32_t>(offset), high);
    time.sleep_until(time.now_ns() + kServed_ns);
  }
  bool level(std::size_t offset) { return pins.level(static_cast<std::uint32_t>(offset)); }

  host::GpioSimPins pins{"contract", "contract-lines", 16, kLinesPwmFolder};
  LinuxClock time;
  LinuxGpioLines first{"contract-lines"};
  LinuxGpioLines second{"contract-lines"};
};

INSTANTIATE_TYPED_TEST_SUITE_P(Libgpiod, GpioLinesContract, GpioSimRig);

class LibgpiodLines : public ::testing::Test {
 protected:
  ErrorCode refusal(LinuxGpioLines& lines, std::span<const GpioLineConfig> configs) {
    const auto requested = lines.request({.lines = configs});
    EXPECT_FALSE(requested);
    return requested ? ErrorCode::timeout : requested.error().code;
  }
  void request_encoder() { ASSERT_TRUE(rig_.first.request({.lines = encoder_})); }

  std::array<GpioLineConfig, 3> encoder_{{{.offset = 1, .edges = GpioEdges::both},
                                          {.offset = 2, .edges = GpioEdges::both},
                                          {.offset = 3, .direction = GpioDirection::output}}};
  std::array<GpioEdgeEvent, 64> events_;
  GpioSimRig rig_;
};

TEST_F(LibgpiodLines, RemovedChipIsDisconnectedInEveryCall) {
  request_encoder();
  rig_.pins.unplug();
  EXPECT_EQ(rig_.first.get(1).error().code, ErrorCode::disconnected);
  EXPECT_EQ(rig_.first.set(4, 4).error().code, ErrorCode::disconnected);
  EXPECT_EQ(rig_.first.read_edges(events_, kNoWait).error().code, ErrorCode::disconnected);
  const TimeNs deadline_ns = rig_.time.now_ns() + 50'000'000;
  EXPECT_EQ(rig_.first.read_edges(events_, deadline_ns).error().code, ErrorCode::disconnected);
  rig_.first.release();
  EXPECT_EQ(refusal(rig_.first, encoder_), ErrorCode::not_found);
}

TEST_F(LibgpiodLines, ChipThatCameBackCanBeRequestedAgain) {
  request_encoder();
  rig_.pins.unplug();
  EXPECT_FALSE(rig_.first.get(1));
  rig_.first.release();
  rig_.pins.plug_in();
  request_encoder();
  rig_.drive(1, true);
  EXPECT_EQ(rig_.first.read_edges(events_, kNoWait), 1U);
  EXPECT_EQ(rig_.first.get(0b11), 0b01U);
}

TEST_F(LibgpiodLines, ChipIsFoundByPathToo) {
  LinuxGpioLines wrong("/dev/null");
  EXPECT_EQ(refusal(wrong, encoder_), ErrorCode::not_found);
  LinuxGpioLines missing("/dev/gpiochip99");
  EXPECT_EQ(refusal(missing, encoder_), ErrorCode::not_found);
  LinuxGpioLines unknown("no such label");
  EXPECT_EQ(refusal(unknown, encoder_), ErrorCode::not_found);
  LinuxGpioLines right(rig_.pins.device().string());
  EXPECT_TRUE(right.request({.lines = encoder_}));
}

TEST_F(LibgpiodLines, LabelThatTwoChipsHaveIsRefused) {
  const host::GpioSimPins twin("twin", "contract-lines", 4, kLinesPwmFolder);
  EXPECT_EQ(refusal(rig_.first, encoder_), ErrorCode::invalid_argument);
}

TEST_F(LibgpiodLines, MoreKindsOfLinesThanTheKernelTakesAreNotSupported) {
  std::array<GpioLineConfig, 12> lines;
  for (std::uint32_t i = 0; i < lines.size(); ++i) {
    lines[i] = {.offset = i, .debounce_us = 1000 * (i + 1)};
  }
  EXPECT_EQ(refusal(rig_.first, lines), ErrorCode::not_supported);
  EXPECT_TRUE(rig_.first.request({.lines = std::span(lines).first(4)}));
}

TEST_F(LibgpiodLines, OpenInputFollowsItsPull) {
  const std::array pulled{GpioLineConfig{.offset = 5, .bias = GpioBias::pull_up},
                          GpioLineConfig{.offset = 6, .bias = GpioBias::pull_down}};
  ASSERT_TRUE(rig_.first.request({.lines = pulled}));
  EXPECT_EQ(rig_.first.get(0b11), 0b01U);
}

TEST_F(LibgpiodLines, NothingAllocatesBetweenRequestAndRelease) {
  request_encoder();
  for (std::uint32_t i = 0; i < 200; ++i) {
    rig_.pins.drive(1 + i % 2, i % 4 < 2);
  }
  rig_.time.sleep_until(rig_.time.now_ns() + 10'000'000);
  const testing::HeapTrap trap;
  std::size_t edges = 0;
  for (int i = 0; i < 10; ++i) {
    edges += rig_.first.read_edges(events_, kNoWait).value_or(0);
    static_cast<void>(rig_.first.get(0b111));
    static_cast<void>(rig_.first.set(0b100, 0b100));
    static_cast<void>(rig_.first.read_edges(events_, rig_.time.now_ns() + 1000));
  }
  EXPECT_EQ(trap.calls(), 0U);
  EXPECT_GT(edges, 0U);
}

}  // namespace
}  // namespace tactus::hal
