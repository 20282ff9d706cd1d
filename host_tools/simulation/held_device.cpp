#include "host_tools/simulation/held_device.h"

#include <cmath>

namespace tactus::host {
namespace {

// Returns true in the one tick into which an event's time falls.
bool due(double at_s, std::uint64_t tick, double tick_s) {
  return std::floor(at_s / tick_s + 1e-9) == static_cast<double>(tick);
}

// Returns the device's total delay for the passivity controller. A first-order motor counts as a
// delay of its time constant.
double delay_of(const DeviceParameters& device, double tick_s) {
  return 1e-6 * device.sample_age_us + tick_s * static_cast<double>(device.delay_ticks) +
         device.motor_time_constant_s;
}

}  // namespace

HeldDevice::HeldDevice(const SimulationConfig& config)
    : faults_(config.faults),
      requests_(config.requests),
      tick_s_(1.0 / config.rate_hz),
      origin_B_(config.device.centre_B - config.path.middle()),
      hand_(config.hand, config.path, config.seed, tick_s_),
      device_(config.device.device, tick_s_, hand_.wish_W() + origin_B_) {}

firmware::ControllerConfig HeldDevice::controller_config(const SimulationConfig& config) const {
  firmware::ControllerConfig controller = config.controller;
  controller.rate_hz = config.rate_hz;
  controller.workspace_origin_D = origin_B_;
  controller.safety.device_delay_s = delay_of(config.device.device, tick_s_);
  return controller;
}

void HeldDevice::inject_planned() {
  for (const FaultEvent& event : faults_) {
    if (due(event.at_s, ticks_, tick_s_)) {
      device_.inject(event.fault, event.ticks);
    }
  }
}

firmware::Request HeldDevice::request(firmware::Mode mode) const {
  for (const RequestEvent& event : requests_) {
    if (due(event.at_s, ticks_, tick_s_)) {
      return event.request;
    }
  }
  return firmware::request_toward_active(mode);
}

void HeldDevice::advance() {
  device_.advance(hand_.parameters(), hand_.wish_W() + origin_B_, hand_.next_wish_W() + origin_B_);
  hand_.advance();
  ++ticks_;
}

}  // namespace tactus::host
