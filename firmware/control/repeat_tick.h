// Repeats a recorded tick, for replays and their tests. One thread; as fast as a tick.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "drivers/device.h"
#include "firmware/control/controller.h"
#include "firmware/telemetry/record.h"

namespace tactus::firmware {

// Runs a tick with the recorded inputs: one record for each device of the controller. If the
// controller is in the state in which the recorded tick began, its records are then equal to the
// bit, except for the stage times.
inline void repeat_tick(Controller& controller, std::span<const TelemetryRecord> recorded) {
  std::array<drivers::JointSample, rendering::kMaxTools> samples;
  std::array<Request, rendering::kMaxTools> requests{};
  std::array<drivers::JointCommand, rendering::kMaxTools> commands;
  const std::size_t count = controller.device_count();
  for (std::size_t i = 0; i < count; ++i) {
    const TelemetryRecord& record = recorded[i];
    if (record.change.place.parameter != Parameter::none) {
      // The change was accepted when it was recorded, so it is accepted now.
      static_cast<void>(controller.set_parameter(record.change, i));
    }
    drivers::JointSample& sample = samples[i];
    sample.position = record.joint_position;
    sample.velocity = record.joint_velocity;
    sample.effort = record.joint_measured;
    sample.effort_known = record.effort_known;
    sample.effort_is_new = record.effort_is_new;
    sample.age_us = record.sample_age_us;
    sample.status = record.device_status;
    requests[i] = record.request;
  }
  // There is one loop for all devices.
  controller.note_loop(
      {.status = recorded.front().loop_status, .missed_ticks = recorded.front().missed_ticks});
  controller.tick(std::span(samples).first(count), std::span(requests).first(count),
                  std::span(commands).first(count));
}

// Repeats a tick of a controller with one device.
inline void repeat_tick(Controller& controller, const TelemetryRecord& recorded) {
  repeat_tick(controller, {&recorded, 1});
}

}  // namespace tactus::firmware
