#include "firmware/control/controller.h"

#include <limits>

#include "firmware/limits.h"
#include "firmware/safety/faults.h"

namespace tactus::firmware {

static_assert(sizeof(Controller) <= kMaxControllerBytes,
              "the controller is larger than the profile's controller_bytes (rendering/profiles): "
              "lower a size of the profile, or raise that bound");

drivers::JointCommand Controller::tick(const drivers::JointSample& sample, Request request) {
  drivers::JointCommand command;
  tick({&sample, 1}, {&request, 1}, {&command, 1});
  return command;
}

// Faults are shared after the modes have been advanced, so that a device cannot become active while
// another one is in fault, and again at the end, so that no force goes out beside a new fault.
void Controller::tick(std::span<const drivers::JointSample> samples,
                      std::span<const Request> requests,
                      std::span<drivers::JointCommand> commands) {
  const std::size_t count = device_count();
  for (std::size_t i = 0; i < count; ++i) {
    if (at(i).begin(samples[i], requests[i])) {
      scene_.world.reset(i);
    }
  }
  stop_together();
  for (std::size_t i = 0; i < count; ++i) {
    at(i).locate();
  }
  touch();
  for (std::size_t i = 0; i < count; ++i) {
    at(i).drive();
  }
  stop_together();
  for (std::size_t i = 0; i < count; ++i) {
    commands[i] = at(i).close();
  }
}

// Stops every device beside one with a fault that concerns all.
void Controller::stop_together() {
  if (more_devices_.empty()) {
    return;
  }
  for (std::size_t faulted = 0; faulted < device_count(); ++faulted) {
    if (at(faulted).faults_for_all() == kNoFault) {
      continue;
    }
    for (std::size_t i = 0; i < device_count(); ++i) {
      if (i != faulted) {
        at(i).stop_for(faulted);
      }
    }
  }
}

// Computes all touches. The world stands still in a tick in which no tool touches it.
void Controller::touch() {
  if (!more_devices_.empty()) {
    touch_several();
    return;
  }
  if (!first_device_.touches()) {
    first_device_.take(free_touch(first_device_.tool()));
    return;
  }
  advance_changes();
  first_device_.take(scene_.world.touch(first_device_.tool(), first_device_.watcher()));
}

void Controller::touch_several() {
  // A tool that does not touch is no number for the world, which then holds its proxies.
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  std::array<rendering::ToolState, rendering::kMaxTools> tools;
  std::array<rendering::Touch, rendering::kMaxTools> touches;
  std::array<rendering::TickWatcher*, rendering::kMaxTools> watchers{};
  const std::size_t count = device_count();
  bool any = false;
  for (std::size_t i = 0; i < count; ++i) {
    const bool is_there = at(i).touches();
    any = any || is_there;
    tools[i] = is_there ? at(i).tool() : rendering::ToolState{.p_W = Vec3::Constant(kNone)};
    watchers[i] = is_there ? at(i).watcher() : nullptr;
  }
  if (any) {
    advance_changes();
    scene_.world.touch(std::span(tools).first(count), std::span(touches).first(count), watchers);
  }
  for (std::size_t i = 0; i < count; ++i) {
    at(i).take(at(i).touches() ? touches[i] : free_touch(at(i).tool()));
  }
}

// Advances the changes of materials. They change the force no faster than an activation with the
// largest force does; without force they act at once.
void Controller::advance_changes() {
  if (!scene_.changes.any()) {
    return;
  }
  double most_N = std::numeric_limits<double>::infinity();
  double speed_m_per_s = 0.0;
  bool is_active = false;
  for (std::size_t i = 0; i < device_count(); ++i) {
    const DeviceController& device = at(i);
    if (device.mode() == Mode::active) {
      is_active = true;
      most_N = std::min(most_N, device.largest_change_N());
      speed_m_per_s = std::max(speed_m_per_s, length_of(device.tool().v_W));
    }
  }
  if (!is_active) {
    scene_.complete_changes();
    return;
  }
  if (!scene_.advance_changes(most_N, speed_m_per_s)) {
    return;
  }
  for (std::size_t i = 0; i < device_count(); ++i) {
    if (at(i).mode() == Mode::active) {
      at(i).note_change();
    }
  }
}

void Controller::set_clock(NowNs now_ns) {
  for (std::size_t i = 0; i < device_count(); ++i) {
    at(i).set_clock(now_ns);
  }
}

void Controller::note_loop(const LoopReport& report) {
  for (std::size_t i = 0; i < device_count(); ++i) {
    at(i).note_loop(report);
  }
}

}  // namespace tactus::firmware
