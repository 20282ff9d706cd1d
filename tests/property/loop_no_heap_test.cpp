// The whole loop never touches the heap: its timing, the controller in contact, the watchdog's
// line, and the thread that stands beside it.
#include <gtest/gtest.h>

#include <cmath>

#include "firmware/tactusd/loop.h"
#include "firmware/tactusd/supervisor.h"
#include "hal/simulated/gpio_chip.h"
#include "hal/simulated/gpio_lines.h"
#include "tests/support/heap_trap.h"
#include "tests/support/solid.h"

namespace tactus::testing {
namespace {

// Strokes over a sphere of 50 mm, deep enough to stay in contact, once it has been away from it.
class StrokingDevice {
 public:
  static std::size_t joint_count() { return firmware::kJointCount; }
  void read(drivers::JointSample& sample) {
    const double t = 1e-3 * static_cast<double>(tick_);
    const double r = tick_ < 10 ? 0.1 : 0.0505 + 0.001 * std::sin(11.0 * t);
    sample = {};
    sample.position = {r * std::cos(2.0 * t), 0.0, r * std::sin(2.0 * t)};
    ++tick_;
  }
  static std::uint32_t write(const drivers::JointCommand& /*command*/) {
    return drivers::kDeviceOk;
  }
  static void clear_faults() {}

 private:
  int tick_ = 0;
};
static_assert(drivers::Device<StrokingDevice>);

class CountingDoors {
 public:
  explicit CountingDoors(firmware::Supervisor& supervisor) : supervisor_(&supervisor) {}

  static bool stopping() { return false; }
  static firmware::Request take_request(const firmware::Controller& controller) {
    const firmware::Mode mode = controller.mode();
    return mode == firmware::Mode::init    ? firmware::Request::home
           : mode == firmware::Mode::ready ? firmware::Request::enable
                                           : firmware::Request::none;
  }
  void publish(const firmware::Controller& controller, const firmware::LoopTick& /*tick*/) {
    supervisor_->note(controller.mode());
    contacts += controller.record().contact != rendering::ContactKind::none ? 1 : 0;
  }

  int contacts = 0;

 private:
  firmware::Supervisor* supervisor_;
};

TEST(Loop, NeverUsesTheHeapFromItsFirstTickToItsLast) {
  constexpr std::uint64_t kTicks = 20'000;
  const Solid solid(bumpy_sphere(0.05, 4, 0.02), rendering::Sides::one,
                    {.stiffness_N_per_m = 1000.0, .friction = rendering::cone_friction(0.6, 0.4)});
  static firmware::Controller controller;
  static firmware::LoopTiming timing;
  ASSERT_TRUE(controller.configure(firmware::cartesian_config()));
  ASSERT_TRUE(controller.load_scene({&solid.object(), 1}, {.tool_radius_m = 0.002}));

  hal::SimulatedClock clock;
  hal::SimulatedGpioChip chip(clock);
  hal::SimulatedGpioLines lines(chip);
  firmware::WatchdogOutput watchdog;
  ASSERT_TRUE(watchdog.open(lines, {.offset = 1, .direction = hal::GpioDirection::output}));
  const firmware::ServiceNotice notice;
  firmware::Supervisor supervisor;
  ASSERT_EQ(supervisor.start(notice), 0);
  StrokingDevice device;
  CountingDoors doors(supervisor);
  const firmware::LoopConfig config{.phase = firmware::loop_phase(1000.0), .ticks = kTicks};
  const firmware::LoopParts parts{
      .controller = controller, .clock = clock, .timing = timing, .watchdog = watchdog};

  std::size_t calls = 0;
  firmware::LoopEnd end{};
  {
    const HeapTrap trap;
    end = firmware::run_loop(config, parts, device, doors);
    calls = trap.calls();
  }
  EXPECT_EQ(calls, 0U);
  EXPECT_EQ(end, firmware::LoopEnd::ended);
  EXPECT_EQ(controller.mode(), firmware::Mode::active);
  EXPECT_GT(doors.contacts, static_cast<int>(kTicks / 2));
}

}  // namespace
}  // namespace tactus::testing
