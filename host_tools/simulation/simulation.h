// Device, hand and controller in lockstep: one call is one tick of all three. `tactus sim`, its
// served form and the whole-loop tests drive it in their own process.
//
// It is deterministic: the same configuration and scene give the same bits in every tick, which the
// record's state hash, a chain over all ticks, shows. One thread; the heap is used at construction
// only.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "firmware/control/controller.h"
#include "firmware/control/run_tick.h"
#include "host_tools/simulation/device_presets.h"
#include "host_tools/simulation/hand.h"
#include "host_tools/simulation/simulated_device.h"
#include "host_tools/simulation/wish_path.h"
#include "rendering/objects/object.h"
#include "rendering/world/world.h"

namespace tactus::host {

// A device fault at a time of the run.
struct FaultEvent {
  // When it begins, s from the start of the run.
  double at_s = 0.0;
  DeviceFault fault = DeviceFault::stale_sample;
  // How many ticks it lasts.
  std::uint32_t ticks = 1;
};

// A request of the operator at a time of the run, besides homing and enabling, which the simulation
// requests by itself.
struct RequestEvent {
  // When it is made, s from the start of the run.
  double at_s = 0.0;
  firmware::Request request = firmware::Request::none;
};

// Everything that determines a run but the scene.
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
  // The radius of the tool is given apart.
  rendering::WorldConfig world;
};

// A simulated run.
class Simulation {
 public:
  // Places the handle at rest where the hand wants it, and the device so that the middle of the
  // wish path lies in the middle of its workspace. The memory of `objects` must outlive the
  // simulation. Throws InputError if the device, the controller or the world refuses its
  // configuration.
  Simulation(const SimulationConfig& config, std::span<const rendering::Object> objects,
             double tool_radius_m);

  // Makes one tick: the planned faults and requests, then read, controller and write; then it
  // advances device and hand to the next tick.
  void tick();

  // Makes one tick with that request alone, and with the device that `between(device)` returns in
  // the device's place. The planned faults and requests are left out.
  template <class Between>
  void tick(firmware::Request request, Between&& between) {
    wish_W_ = hand_.wish_W();
    auto&& device = between(device_);
    firmware::run_tick(*controller_, device, request);
    advance();
  }

  // Returns the record of the last tick.
  [[nodiscard]] const firmware::TelemetryRecord& record() const { return controller_->record(); }
  // Returns the wished position at the last tick, m, world frame.
  [[nodiscard]] const Vec3& wish_W() const { return wish_W_; }
  // Returns the device after the last tick, that is, at the start of the next one.
  [[nodiscard]] const SimulatedDevice& device() const { return device_; }
  // Returns the true position of the handle, m, world frame.
  [[nodiscard]] Vec3 handle_W() const { return device_.plant().p_B() - origin_B_; }

  // Returns the configuration that the controller has taken.
  [[nodiscard]] const firmware::ControllerConfig& config() const { return controller_->config(); }
  [[nodiscard]] firmware::Controller& controller() { return *controller_; }

 private:
  // Returns the operator's request of this tick: a planned one, else home from `init` and enable
  // from `ready`.
  [[nodiscard]] firmware::Request request_now() const;
  void advance();

  std::vector<FaultEvent> faults_;
  std::vector<RequestEvent> requests_;
  double tick_s_;
  // The world's origin in the device's base frame, m.
  Vec3 origin_B_;
  Hand hand_;
  SimulatedDevice device_;
  // On the heap, since it has half a megabyte.
  std::unique_ptr<firmware::Controller> controller_;
  Vec3 wish_W_ = Vec3::Zero();
  std::uint64_t ticks_ = 0;
};

}  // namespace tactus::host
