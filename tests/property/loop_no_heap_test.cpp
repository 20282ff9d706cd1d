// The whole loop never touches the heap: its timing, the controller in contact, the watchdog's
// line, commands in and telemetry out, with an explanation of every tick and the places of what
// moves. Nor do the threads that stand beside it, which tell, record and write the flight recorder
// out.
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <string>

#include "firmware/commands/command_queue.h"
#include "firmware/linux/flight/flight_writer.h"
#include "firmware/linux/tactusd/loop.h"
#include "firmware/linux/tactusd/supervisor.h"
#include "firmware/linux/telemetry/explanation_source.h"
#include "firmware/linux/telemetry/live_socket.h"
#include "firmware/linux/telemetry/places_source.h"
#include "firmware/linux/telemetry/telemetry_writer.h"
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

// The objects beside the loop; static, as in tactusd.
struct Beside {
  firmware::Supervisor supervisor;
  firmware::CommandQueue desk;
  firmware::TelemetryWriter telemetry;
  firmware::ExplanationSource explanations;
  firmware::PlacesSource places;
  firmware::FlightWriter flight;
};

// Commands every hundredth tick, all of it published.
class BusyHooks {
 public:
  explicit BusyHooks(Beside& beside) : beside_(&beside) {}

  static bool stopping() { return false; }
  static bool has_crashed() { return false; }
  void take_requests(firmware::Controller& controller, std::span<firmware::Request> requests) {
    if (ticks_ % 100 == 99) {
      beside_->desk.post({.kind = firmware::CommandKind::set,
                          .change = {.place = {.parameter = firmware::Parameter::max_force},
                                     .value = 4.0 + ticks_ / 100 % 2}});
    }
    if (ticks_ == kFlightAt) {
      beside_->flight.ask();
    }
    beside_->desk.before_tick(controller);
    requests[0] = firmware::request_toward_active(controller.mode());
  }
  void publish(firmware::Controller& controller, const firmware::LoopTick& tick) {
    beside_->desk.after_tick(controller);
    while (const auto answer = beside_->desk.next_answer()) {
      changes += answer->outcome == firmware::Outcome::done ? 1 : 0;
    }
    firmware::RecordedTick recorded{
        .record = controller.record(),
        .loop = {
            .scheduled_ns = tick.scheduled_ns, .woke_ns = tick.woke_ns, .done_ns = tick.done_ns}};
    beside_->flight.add(recorded, controller);
    beside_->telemetry.publish(recorded);
    beside_->explanations.after_tick(controller, tick.scheduled_ns, beside_->telemetry);
    explained += beside_->telemetry.wants_explanations() ? 1 : 0;
    beside_->places.after_tick(controller, tick.scheduled_ns, beside_->telemetry);
    placed += beside_->telemetry.wants_places() ? 1 : 0;
    beside_->supervisor.note(std::array{controller.mode()});
    contacts += controller.record().contact != rendering::ContactKind::none ? 1 : 0;
    ++ticks_;
  }

  int contacts = 0;
  int changes = 0;
  int explained = 0;
  int placed = 0;

 private:
  static constexpr int kFlightAt = 10'000;

  Beside* beside_;
  int ticks_ = 0;
};

// Connects to a live socket and asks it for explanations and places. It reads nothing, which the
// socket bears.
hal::FileDescriptor ask_for_everything(const std::string& socket) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::ranges::copy(socket, std::begin(address.sun_path));
  hal::FileDescriptor reader(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
  EXPECT_EQ(::connect(reader.get(), reinterpret_cast<const sockaddr*>(&address), sizeof(address)),
            0);
  const std::array wishes{firmware::kWantExplanations, firmware::kWantPlaces};
  EXPECT_EQ(::send(reader.get(), wishes.data(), wishes.size(), 0), 2);
  return reader;
}

// A ball that goes to and fro, far from the stroke.
rendering::Object moving_ball(const rendering::Motion& motion) {
  rendering::Object ball;
  ball.surface = rendering::SurfaceKind::primitive;
  ball.primitive = {.kind = rendering::PrimitiveKind::sphere, .dimensions_m = {0.01}};
  ball.primitive.X_WO.translation = {0.5, 0.0, 0.0};
  ball.material = {.stiffness_N_per_m = 1000.0};
  ball.moves = true;
  ball.motion = &motion;
  return ball;
}

TEST(Loop, NeverUsesTheHeapFromItsFirstTickToItsLast) {
  constexpr std::uint64_t kTicks = 20'000;
  const Solid solid(bumpy_sphere(0.05, 4, 0.02), rendering::Sides::one,
                    {.stiffness_N_per_m = 1000.0, .friction = rendering::cone_friction(0.6, 0.4)});
  static firmware::Controller controller;
  static firmware::LoopTiming timing;
  ASSERT_TRUE(controller.configure(firmware::cartesian_config()));
  const rendering::Motion motion{.sway_W = {0.0, 0.1, 0.0}, .sway_Hz = 1.0};
  const std::array objects{solid.object(), moving_ball(motion)};
  ASSERT_TRUE(controller.load_scene(objects, {.tool_radius_m = 0.002}));

  hal::SimulatedClock clock;
  hal::SimulatedGpioChip chip(clock);
  hal::SimulatedGpioLines lines(chip);
  firmware::WatchdogOutput watchdog;
  ASSERT_TRUE(watchdog.open(lines, {.offset = 1, .direction = hal::GpioDirection::output}));
  const firmware::ServiceNotice notice;
  static Beside beside;
  const std::string folder = std::string(::testing::TempDir()) + "loop-no-heap";
  std::filesystem::create_directories(folder);
  ASSERT_EQ(beside.supervisor.start(notice), 0);
  ASSERT_EQ(beside.telemetry.record((folder + "/run.mcap").c_str()), 0);
  const std::string socket = folder + "/telemetry.sock";
  ASSERT_EQ(beside.telemetry.open_live_socket(socket.c_str()), 0);
  ASSERT_EQ(beside.telemetry.start(), 0);
  const hal::FileDescriptor reader = ask_for_everything(socket);
  while (!beside.telemetry.wants_explanations()) {
    usleep(1000);
  }
  ASSERT_EQ(beside.flight.start({.folder = folder.c_str()}), 0);
  StrokingDevice device;
  BusyHooks hooks(beside);
  const firmware::LoopConfig config{.phase = firmware::loop_phase(1000.0), .ticks = kTicks};
  const std::array devices{&device};
  const std::array watchdogs{&watchdog};
  const firmware::LoopParts parts{
      .controller = controller, .clock = clock, .timing = timing, .watchdogs = watchdogs};

  std::size_t calls = 0;
  firmware::LoopEnd end{};
  {
    const HeapTrap trap;
    end = firmware::run_loop(config, parts, std::span(devices), hooks);
    while (beside.flight.files() == 0) {
      usleep(1000);
    }
    calls = trap.calls();
  }
  beside.flight.stop();
  beside.telemetry.stop();
  beside.supervisor.stop();
  std::filesystem::remove_all(folder);
  EXPECT_EQ(calls, 0U);
  EXPECT_EQ(end, firmware::LoopEnd::ended);
  EXPECT_EQ(controller.mode(), firmware::Mode::active);
  EXPECT_EQ(hooks.changes, static_cast<int>(kTicks / 100));
  EXPECT_GT(hooks.contacts, static_cast<int>(kTicks / 2));
  EXPECT_GT(hooks.explained, 0);
  EXPECT_GT(hooks.placed, 0);
}

}  // namespace
}  // namespace tactus::testing
