// A simulated device in its place of the world, with the hand that holds it and the operator who
// requests its modes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "firmware/configuration/controller_config.h"
#include "firmware/control/mode.h"
#include "host_tools/simulation/device_presets.h"
#include "host_tools/simulation/hand.h"
#include "host_tools/simulation/simulated_device.h"
#include "host_tools/simulation/wish_path.h"
#include "rendering/world/world.h"

namespace tactus::host {

// A device fault at a time of the run.
struct FaultEvent {
  // When it begins, s from the start of the run.
  double at_s = 0.0;
  DeviceFault fault = DeviceFault::stale_sample;
  // The number of ticks that it lasts.
  std::uint32_t ticks = 1;
};

// A request of the operator at a time of the run, besides homing and enabling, which the simulation
// requests by itself.
struct RequestEvent {
  // When it is made, s from the start of the run.
  double at_s = 0.0;
  firmware::Request request = firmware::Request::none;
};

// Everything that determines a device's part of a run but the scene's objects.
struct SimulationConfig {
  // The simulated device and where its workspace is.
  DevicePreset device = cartesian_preset();
  // The controller's configuration; its rate, workspace origin and device delay are replaced by
  // those of this simulation.
  firmware::ControllerConfig controller = firmware::cartesian_config();
  // The hand that holds the handle.
  HandParameters hand = kPenHand;
  // The path that the hand wants to follow, world frame.
  WishPath path;
  // Chooses the hand's tremor.
  std::uint64_t seed = 1;
  // Ticks a second of simulated time.
  double rate_hz = 1000.0;
  // The faults that occur, and the operator's requests, in any order.
  std::vector<FaultEvent> faults;
  std::vector<RequestEvent> requests;
  // The scene beside its objects: effects, bodies and gravity, which must outlive the simulation.
  // The radius of the tool is given apart. Of several devices, the first one's counts.
  rendering::WorldConfig world;
};

// One device of a simulation.
class HeldDevice {
 public:
  // Places the handle at rest where the hand wants it, and the device so that the middle of the
  // wish path lies in the middle of its workspace. Throws InputError if a parameter of the device
  // is out of range.
  explicit HeldDevice(const SimulationConfig& config);

  // Returns the controller's configuration, with the rate, origin and delay of this device.
  [[nodiscard]] firmware::ControllerConfig controller_config(const SimulationConfig& config) const;

  // Starts the faults that are planned for this tick.
  void inject_planned();
  // Returns the operator's request of this tick: a planned one, else home from `init` and enable
  // from `ready`.
  [[nodiscard]] firmware::Request request(firmware::Mode mode) const;

  // Advances device and hand to the next tick.
  void advance();

  [[nodiscard]] SimulatedDevice& device() { return device_; }
  [[nodiscard]] const SimulatedDevice& device() const { return device_; }
  // Returns the wished position at this tick, m, world frame.
  [[nodiscard]] Vec3 wish_W() const { return hand_.wish_W(); }
  // Returns the true position of the handle, m, world frame.
  [[nodiscard]] Vec3 handle_W() const { return device_.plant().p_B() - origin_B_; }

 private:
  std::vector<FaultEvent> faults_;
  std::vector<RequestEvent> requests_;
  double tick_s_;
  // The world's origin in the device's base frame, m.
  Vec3 origin_B_;
  Hand hand_;
  SimulatedDevice device_;
  std::uint64_t ticks_ = 0;
};

}  // namespace tactus::host
