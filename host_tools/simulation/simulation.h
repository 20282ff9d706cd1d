// Devices, hands and the controller in lockstep: one call is one tick of all. `tactus sim`, its
// served form and the whole-loop tests drive it in their own process.
//
// It is deterministic: the same configurations and scene give the same bits in every tick, which
// the record's state hash, a chain over all ticks, shows. One thread; the heap is used at
// construction only.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <type_traits>
#include <vector>

#include "firmware/control/controller.h"
#include "firmware/control/run_tick.h"
#include "host_tools/heap_controller.h"
#include "host_tools/simulation/held_device.h"
#include "rendering/limits.h"
#include "rendering/objects/object.h"
#include "rendering/world/world.h"

namespace tactus::host {

// A simulated run of one or several devices. A device is meant by its number; the default is the
// first one.
class Simulation {
 public:
  // Begins a run of one device. The memory of `objects` must outlive the simulation. Throws
  // InputError if the device, the controller or the world refuses its configuration.
  Simulation(const SimulationConfig& config, std::span<const rendering::Object> objects,
             double tool_radius_m)
      : Simulation(std::span(&config, 1), objects, tool_radius_m) {}
  // Begins a run of up to kMaxTools devices in one world.
  Simulation(std::span<const SimulationConfig> devices, std::span<const rendering::Object> objects,
             double tool_radius_m);

  // Makes one tick: the planned faults and requests, then read, controller and write; then it
  // advances devices and hands to the next tick.
  void tick();

  // Makes one tick with these requests alone, one for each device, and with what
  // `between(device, number)` returns in each device's place. The planned faults and requests are
  // left out.
  template <class Between>
  void tick(std::span<const firmware::Request> requests, Between&& between) {
    using Device = std::decay_t<decltype(between(held_.front().device(), std::size_t{0}))>;
    std::array<std::optional<Device>, rendering::kMaxTools> devices;
    std::array<Device*, rendering::kMaxTools> places{};
    for (std::size_t i = 0; i < held_.size(); ++i) {
      places[i] = &devices[i].emplace(between(held_[i].device(), i));
    }
    firmware::run_tick(*controller_, std::span<Device* const>(places).first(held_.size()),
                       requests);
    advance();
  }

  // Returns the number of devices.
  [[nodiscard]] std::size_t device_count() const { return held_.size(); }
  // Returns the record of the last tick.
  [[nodiscard]] const firmware::TelemetryRecord& record(std::size_t device = 0) const {
    return controller_->record(device);
  }
  // Returns the wished position at the last tick, m, world frame.
  [[nodiscard]] const Vec3& wish_W(std::size_t device = 0) const { return wishes_W_[device]; }
  // Returns the device after the last tick, that is, at the start of the next one.
  [[nodiscard]] const SimulatedDevice& device(std::size_t number = 0) const {
    return held_[number].device();
  }
  // Returns the true position of the handle, m, world frame.
  [[nodiscard]] Vec3 handle_W(std::size_t device = 0) const { return held_[device].handle_W(); }

  // Returns the configuration that the controller has taken.
  [[nodiscard]] const firmware::ControllerConfig& config(std::size_t device = 0) const {
    return controller_->config(device);
  }
  [[nodiscard]] const firmware::Controller& controller() const { return *controller_; }
  [[nodiscard]] firmware::Controller& controller() { return *controller_; }

 private:
  void advance();

  // Returns the configurations, or throws InputError if there are none or more than kMaxTools.
  static std::span<const SimulationConfig> checked(std::span<const SimulationConfig> devices);

  std::vector<HeldDevice> held_;
  HeapController controller_;
  std::vector<Vec3> wishes_W_;
};

}  // namespace tactus::host
