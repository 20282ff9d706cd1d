// A saved state of the controller with any bytes of it changed: it is refused, or the controller
// goes on with a bounded, finite command.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "firmware/control/controller.h"
#include "tests/fuzz/fuzz_input.h"
#include "tests/support/solid.h"

namespace tactus {
namespace {

constexpr double kBall_m = 0.05;
constexpr double kTool_m = 0.002;
constexpr rendering::Material kMaterial{.stiffness_N_per_m = 500.0,
                                        .friction = rendering::cone_friction(0.6, 0.4)};

// A ball and before it a disc, as dense in its middle as takes several ticks to look at, that are
// touched, and a ball that moves.
std::array<rendering::Object, 3> scene() {
  static const testing::Solid disc(
      testing::moved(testing::disc(300, 0.01, 0.0), {0.0, kBall_m + 0.0005, 0.0}),
      rendering::Sides::one, kMaterial);
  const rendering::Object ball{
      .surface = rendering::SurfaceKind::primitive,
      .primitive = {.kind = rendering::PrimitiveKind::sphere, .dimensions_m = {kBall_m, 0.0, 0.0}},
      .material = kMaterial};
  std::array<rendering::Object, 3> objects{ball, ball, disc.object()};
  objects[1].moves = true;
  return objects;
}

// The tool comes over the disc, and presses on it.
drivers::JointSample sample(std::size_t tick) {
  drivers::JointSample sample;
  sample.position[1] = kBall_m + (tick < 2 ? 0.004 : 0.001);
  sample.position[0] = 1e-5 * static_cast<double>(tick);
  return sample;
}

void begin(firmware::Controller& controller, const std::array<rendering::Object, 3>& objects) {
  fuzz::require(controller.configure(firmware::cartesian_config()).has_value(), "configured");
  fuzz::require(controller.load_scene(objects, {.tool_radius_m = kTool_m}).has_value(), "loaded");
}

}  // namespace
}  // namespace tactus

// The first byte of the input is how long the controller has run; of each three that follow two are
// a place and the third the byte that is put there.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tactus;
  constexpr std::size_t kMostTicks = 16;
  static const auto objects = scene();
  static firmware::Controller controller;
  begin(controller, objects);
  std::size_t tick = 0;
  controller.tick(sample(tick++), firmware::Request::home);
  controller.tick(sample(tick++), firmware::Request::none);
  controller.tick(sample(tick++), firmware::Request::enable);
  for (const std::size_t end = tick + (size > 0 ? data[0] % kMostTicks : 0); tick < end; ++tick) {
    controller.tick(sample(tick), firmware::Request::none);
  }
  std::vector<std::byte> state(firmware::kMaxCheckpointBytes);
  state.resize(controller.save(state));
  fuzz::require(!state.empty(), "a state is saved");
  for (std::size_t i = 1; i + 2 < size; i += 3) {
    const std::size_t place = (std::size_t{data[i]} << 8U) | data[i + 1];
    state[place % state.size()] = static_cast<std::byte>(data[i + 2]);
  }
  begin(controller, objects);
  if (controller.restore(state)) {
    for (const std::size_t end = tick + 4; tick < end; ++tick) {
      const drivers::JointCommand command = controller.tick(sample(tick), firmware::Request::none);
      for (const double effort : command.effort) {
        fuzz::require(std::isfinite(effort) && std::abs(effort) <= 10.0, "a bounded effort");
      }
    }
  }
  return 0;
}
