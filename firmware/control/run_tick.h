// One cycle of the device loop for any device: read, tick, write. It is what tactusd, the simulator
// and the replay's tests have in common.
#pragma once

#include "drivers/device.h"
#include "firmware/control/controller.h"

namespace tactus::firmware {

// Reads a sample, runs a tick and writes the command. It takes as long as the device's two
// transfers and the tick. The next tick gets the status of the write. A reset in mode `fault` first
// clears the faults that the device has latched. Real time if the device is; the loop's thread.
template <drivers::Device D>
void run_tick(Controller& controller, D& device, Request request) {
  if (request == Request::reset && controller.mode() == Mode::fault) {
    device.clear_faults();
  }
  drivers::JointSample sample;
  Stopwatch read_watch(controller.clock());
  device.read(sample);
  const std::uint32_t read_ns = read_watch.lap_ns();

  const drivers::JointCommand command = controller.tick(sample, request);

  Stopwatch write_watch(controller.clock());
  const std::uint32_t write_status = device.write(command);
  controller.note_transfers(write_status, read_ns, write_watch.lap_ns());
}

}  // namespace tactus::firmware
