// A saved state of the controller with any bytes of it changed: it is refused, or the controller
// goes on with a bounded, finite command.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "firmware/control/controller.h"
#include "tests/fuzz/fuzz_input.h"

namespace tactus {
namespace {

// A ball that is touched, and one that moves.
std::array<rendering::Object, 2> scene() {
  std::array<rendering::Object, 2> objects;
  for (rendering::Object& object : objects) {
    object.surface = rendering::SurfaceKind::primitive;
    object.primitive = {.kind = rendering::PrimitiveKind::sphere, .dimensions_m = {0.05, 0.0, 0.0}};
    object.material = {.stiffness_N_per_m = 500.0, .friction = rendering::cone_friction(0.6, 0.4)};
  }
  objects[1].moves = true;
  return objects;
}

drivers::JointSample sample() {
  drivers::JointSample sample;
  sample.position[0] = 0.049;
  return sample;
}

void begin(firmware::Controller& controller, const std::array<rendering::Object, 2>& objects) {
  fuzz::require(controller.configure(firmware::cartesian_config()).has_value(), "configured");
  fuzz::require(controller.load_scene(objects, {.tool_radius_m = 0.002}).has_value(), "loaded");
}

}  // namespace
}  // namespace tactus

// Each three bytes of the input: where, 16 bits, and the byte that is put there.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tactus;
  static const auto objects = scene();
  static firmware::Controller controller;
  begin(controller, objects);
  controller.tick(sample(), firmware::Request::home);
  controller.tick(sample(), firmware::Request::none);
  controller.tick(sample(), firmware::Request::enable);
  std::vector<std::byte> state(firmware::kMaxCheckpointBytes);
  state.resize(controller.save(state));
  fuzz::require(!state.empty(), "a state is saved");
  for (std::size_t i = 0; i + 2 < size; i += 3) {
    const std::size_t place = (std::size_t{data[i]} << 8U) | data[i + 1];
    state[place % state.size()] = static_cast<std::byte>(data[i + 2]);
  }
  begin(controller, objects);
  if (controller.restore(state)) {
    const drivers::JointCommand command = controller.tick(sample(), firmware::Request::none);
    for (const double effort : command.effort) {
      fuzz::require(std::isfinite(effort) && std::abs(effort) <= 10.0, "a bounded effort");
    }
  }
  return 0;
}
