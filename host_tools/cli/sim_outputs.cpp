#include "host_tools/cli/sim_outputs.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

#include "hal/linux/system.h"
#include "host_tools/files/output_place.h"

namespace tactus::host {
namespace {

// The clock of the steps' times, which nothing of the simulation depends on.
std::uint64_t steady_now_ns() {
  return static_cast<std::uint64_t>(hal::monotonic_now_ns());
}

}  // namespace

SimOutputs::SimOutputs(const SimFiles& files, double seconds, Simulation& simulation,
                       const MappedScene& scene)
    : seconds_(seconds), bodies_(files.bodies, scene.image()) {
  for (std::size_t i = 0; i < simulation.device_count(); ++i) {
    OfDevice& device = devices_.emplace_back();
    if (!files.output.empty()) {
      device.rows.emplace(file_of_tool(files.output, i));
    }
    if (!files.hashes.empty()) {
      device.hashes.emplace(file_of_tool(files.hashes, i));
    }
    if (!files.record.empty()) {
      device.recording.emplace(file_of_tool(files.record, i), simulation, scene.bytes(), i);
    }
    if (!files.explain.empty()) {
      device.explanation.emplace(file_of_tool(files.explain, i), simulation.controller(),
                                 scene.image().tool_radius_m(), steady_now_ns, i);
    }
  }
  if (::isatty(STDERR_FILENO) == 1) {
    progress_.emplace();
  }
}

void SimOutputs::begin_tick(const Simulation& simulation) {
  const firmware::Controller& controller = simulation.controller();
  bodies_.add(static_cast<double>(controller.next_tick()) / controller.config().rate_hz,
              controller.world());
}

void SimOutputs::add(const Simulation& simulation) {
  constexpr std::uint64_t kTicksBetweenSteps = 4096;
  for (std::size_t i = 0; i < devices_.size(); ++i) {
    auto& [rows, hashes, recording, explanation] = devices_[i];
    const firmware::TelemetryRecord& record = simulation.record(i);
    if (rows) {
      rows->add(simulation, i);
    }
    if (hashes) {
      hashes->add(record);
    }
    if (recording) {
      recording->add(simulation);
    }
    if (explanation) {
      const firmware::Explanation summary = explanation->add(record);
      if (recording) {
        recording->add(summary);
      }
    }
  }
  const firmware::TelemetryRecord& first = simulation.record();
  if (progress_ && first.tick % kTicksBetweenSteps == 0) {
    progress_->step(fmt::format("{:.1f} of {:.1f} s simulated, mode {}", first.time_s, seconds_,
                                firmware::mode_name(first.mode)),
                    first.time_s / seconds_);
  }
}

void SimOutputs::close() {
  progress_.reset();
  for (auto& [rows, hashes, recording, explanation] : devices_) {
    if (rows) {
      rows->close();
    }
    if (hashes) {
      hashes->close();
    }
    if (recording) {
      recording->close();
    }
    if (explanation) {
      explanation->close();
    }
  }
  bodies_.close();
}

}  // namespace tactus::host
