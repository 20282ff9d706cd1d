// One cycle of the device loop for any devices: read, tick, write. It is what tactusd, the
// simulator and the replay's tests have in common.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "drivers/device.h"
#include "firmware/control/controller.h"

namespace tactus::firmware {

// Reads a sample of each device, runs a tick and writes the commands; `devices` and `requests` have
// an entry for each device of the controller. It takes as long as the transfers and the tick. The
// next tick gets the status of the writes. A reset in mode `fault` first clears the faults that the
// device has latched. Real time if the devices are; the loop's thread.
template <drivers::Device D, std::size_t kCount>
void run_tick(Controller& controller, std::span<D* const, kCount> devices,
              std::span<const Request> requests) {
  constexpr std::size_t kMost = std::min(kCount, rendering::kMaxTools);
  std::array<drivers::JointSample, kMost> samples;
  std::array<drivers::JointCommand, kMost> commands;
  std::array<std::uint32_t, kMost> read_ns{};
  const std::size_t count = controller.device_count();
  Stopwatch read_watch(controller.clock());
  for (std::size_t i = 0; i < count; ++i) {
    if (requests[i] == Request::reset && controller.mode(i) == Mode::fault) {
      devices[i]->clear_faults();
    }
    devices[i]->read(samples[i]);
    read_ns[i] = read_watch.lap_ns();
  }

  controller.tick(std::span(samples).first(count), requests, std::span(commands).first(count));

  Stopwatch write_watch(controller.clock());
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t write_status = devices[i]->write(commands[i]);
    controller.note_transfers(write_status, read_ns[i], write_watch.lap_ns(), i);
  }
}

// Runs a cycle of a controller with one device.
template <drivers::Device D>
void run_tick(Controller& controller, D& device, Request request) {
  const std::array<D*, 1> devices{&device};
  run_tick(controller, std::span<D* const, 1>(devices), {&request, 1});
}

}  // namespace tactus::firmware
