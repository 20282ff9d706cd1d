// Writes a simulated run as a recording: CSV if the file's name ends in .csv, as tactusd does, else
// MCAP with everything that a replay needs, the configuration and the scene. `tactus sim --record`
// uses it; the recording of a real run is written by tactusd.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>

#include "firmware/linux/telemetry/csv_writer.h"
#include "firmware/linux/telemetry/mcap_writer.h"
#include "host_tools/files/output_place.h"
#include "host_tools/simulation/simulation.h"

namespace tactus::host {

// Returns a device's last tick as a recording has it. There is no clock in a simulation: a tick is
// due at its number times the period.
firmware::RecordedTick recorded_tick(const Simulation& simulation, std::size_t device = 0);

// An open recording. It is written to a temporary file that takes its place at close().
class RunRecording {
 public:
  // Begins a recording of a device, before the first tick. `scene` is the bytes of the scene's
  // image. Throws InputError if the file cannot be written.
  RunRecording(const std::filesystem::path& path, const Simulation& simulation,
               std::span<const std::byte> scene, std::size_t device = 0);

  // Adds the last tick.
  void add(const Simulation& simulation);
  // Adds the explanation of the last tick, which has the tick's time from here. CSV has none.
  void add(firmware::Explanation explanation);
  // Completes the recording and puts it in its place. Throws InputError if any part of it could not
  // be written.
  void close();

 private:
  // The output as the user named it, for messages.
  std::filesystem::path path_;
  OutputPlace place_;
  // Open the temporary file. Throw InputError if it cannot be written.
  void begin_csv(std::size_t joints);
  void begin_mcap(const Simulation& simulation, std::span<const std::byte> scene);

  double rate_hz_;
  std::size_t device_;
  // The writer of the file's format; the other is null.
  std::unique_ptr<firmware::McapWriter> mcap_;
  std::unique_ptr<firmware::CsvWriter> csv_;
};

}  // namespace tactus::host
