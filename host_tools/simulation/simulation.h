// Device, hand and controller in lockstep: one call is one tick of all three.
//
// Deterministic: the same configuration and scene give the same bits, tick by tick, which the
// record's state hash (a chain over all ticks) shows. One thread; the heap is used at construction
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

namespace tactus::host {

// A device fault at a time of the run.
struct FaultEvent {
  double at_s = 0.0;
  DeviceFault fault = DeviceFault::stale_sample;
  std::uint32_t ticks = 1;
};

// A request of the operator at a time of the run, besides homing and enabling at the start.
struct RequestEvent {
  double at_s = 0.0;
  firmware::Request request = firmware::Request::none;
};

struct SimulationConfig {
  DevicePreset device = cartesian_preset();
  firmware::ControllerConfig controller =
      firmware::cartesian_config();  // rate, origin and delay are set here
  HandParameters hand = kPenHand;
  WishPath path;
  std::uint64_t seed = 1;
  double rate_hz = 1000.0;
  std::vector<FaultEvent> faults;
  std::vector<RequestEvent> requests;
  std::span<const rendering::Effect> effects;  // of the scene; they must outlive the simulation
};

class Simulation {
 public:
  // The handle starts at rest where the hand wants it; the device stands so that the middle of the
  // wish path lies in the middle of its workspace. The objects' memory must outlive the simulation.
  // Throws InputError, text for a user, when device or controller refuse their
  // configuration or the world the scene.
  Simulation(const SimulationConfig& config, std::span<const rendering::Object> objects,
             double tool_radius_m);

  // Makes one tick: read, controller, write; then advances device and hand until the next tick.
  void tick();

  // Makes one tick with that request alone and with `between(device)` in the device's place. The
  // faults and requests planned for the run do not happen.
  template <class Between>
  void tick(firmware::Request request, Between&& between) {
    wish_W_ = hand_.wish_W();
    auto&& device = between(device_);
    firmware::run_tick(*controller_, device, request);
    advance();
  }

  // Returns the record of the last tick.
  [[nodiscard]] const firmware::TelemetryRecord& record() const { return controller_->record(); }
  [[nodiscard]] const Vec3& wish_W() const { return wish_W_; }  // m
  // Returns the device after the last tick, that is, at the start of the next.
  [[nodiscard]] const SimulatedDevice& device() const { return device_; }
  [[nodiscard]] Vec3 handle_W() const {
    return device_.plant().p_B() - origin_B_;
  }  // m, true position

  [[nodiscard]] const firmware::ControllerConfig& config() const { return controller_->config(); }
  [[nodiscard]] firmware::Controller& controller() { return *controller_; }

 private:
  [[nodiscard]] firmware::Request request_now() const;
  void advance();

  std::vector<FaultEvent> faults_;
  std::vector<RequestEvent> requests_;
  double tick_s_;
  Vec3 origin_B_;  // the world's origin in the device's base frame, m
  Hand hand_;
  SimulatedDevice device_;
  std::unique_ptr<firmware::Controller> controller_;  // half a megabyte: not for the stack
  Vec3 wish_W_ = Vec3::Zero();
  std::uint64_t ticks_ = 0;
};

}  // namespace tactus::host
