// Repeats a recorded tick, for replays and their tests. One thread; as fast as a tick.
#pragma once

#include "drivers/device.h"
#include "firmware/control/controller.h"
#include "firmware/telemetry/record.h"

namespace tactus::firmware {

// Runs a tick with the recorded inputs. If the controller is in the state in which the recorded
// tick began, its record is then equal to the bit, except for the stage times.
inline void repeat_tick(Controller& controller, const TelemetryRecord& recorded) {
  if (recorded.change.place.parameter != Parameter::none) {
    // The change was accepted when it was recorded, so it is accepted now.
    static_cast<void>(controller.set_parameter(recorded.change));
  }
  drivers::JointSample sample;
  sample.position = recorded.joint_position;
  sample.velocity = recorded.joint_velocity;
  sample.effort = recorded.joint_measured;
  sample.effort_known = recorded.effort_known;
  sample.age_us = recorded.sample_age_us;
  sample.status = recorded.device_status;
  controller.note_loop({.status = recorded.loop_status, .missed_ticks = recorded.missed_ticks});
  controller.tick(sample, recorded.request);
}

}  // namespace tactus::firmware
