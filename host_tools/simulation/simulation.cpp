#include "host_tools/simulation/simulation.h"

#include <fmt/format.h>

#include <array>

#include "firmware/device_file/certificate_words.h"
#include "host_tools/configure_controller.h"
#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

// Room for the longest words about a refused scene.
constexpr std::size_t kRefusalRoom = 1024;

}  // namespace

Simulation::Simulation(std::span<const SimulationConfig> devices,
                       std::span<const rendering::Object> objects, double tool_radius_m)
    : controller_(checked(devices).size()) {
  held_.reserve(devices.size());
  for (const SimulationConfig& config : devices) {
    held_.emplace_back(config);
    wishes_W_.push_back(held_.back().wish_W());
  }
  for (std::size_t i = 0; i < devices.size(); ++i) {
    configure(*controller_, held_[i].controller_config(devices[i]), i);
  }
  rendering::WorldConfig world = devices.front().world;
  world.tool_radius_m = tool_radius_m;
  if (const auto loaded = controller_->load_scene(objects, world); !loaded) {
    std::array<char, kRefusalRoom> room{};
    throw InputError(fmt::format("the controller refused the scene: {}",
                                 firmware::refusal_words(loaded.error(), {}, room)));
  }
}

std::span<const SimulationConfig> Simulation::checked(std::span<const SimulationConfig> devices) {
  if (devices.empty() || devices.size() > rendering::kMaxTools) {
    throw InputError(
        fmt::format("{} devices; there may be 1 to {}", devices.size(), rendering::kMaxTools));
  }
  return devices;
}

void Simulation::tick() {
  std::array<SimulatedDevice*, rendering::kMaxTools> devices{};
  std::array<firmware::Request, rendering::kMaxTools> requests{};
  for (std::size_t i = 0; i < held_.size(); ++i) {
    held_[i].inject_planned();
    devices[i] = &held_[i].device();
    requests[i] = held_[i].request(controller_->mode(i));
  }
  firmware::run_tick(*controller_, std::span<SimulatedDevice* const>(devices).first(held_.size()),
                     std::span(requests).first(held_.size()));
  advance();
}

void Simulation::advance() {
  for (std::size_t i = 0; i < held_.size(); ++i) {
    wishes_W_[i] = held_[i].wish_W();
    held_[i].advance();
  }
}

}  // namespace tactus::host
