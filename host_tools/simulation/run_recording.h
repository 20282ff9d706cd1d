// A simulated run as an MCAP recording, with all that a replay needs: configuration and scene.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>

#include "firmware/linux/telemetry/mcap_writer.h"
#include "host_tools/files/output_place.h"
#include "host_tools/simulation/simulation.h"

namespace tactus::host {

class RunRecording {
 public:
  // Begin it before the first tick. `scene` is the scene's image. Throws InputError, text for a
  // user, when the file cannot be written.
  RunRecording(const std::filesystem::path& path, const Simulation& simulation,
               std::span<const std::byte> scene);

  // Adds a tick; call it after each.
  void add(const Simulation& simulation);
  // Puts the recording in its place. Throws InputError if anything could not be written.
  void close();

 private:
  std::filesystem::path path_;  // as the user named it
  OutputPlace place_;
  double tick_ns_;
  std::unique_ptr<firmware::McapWriter> writer_ = std::make_unique<firmware::McapWriter>();
};

}  // namespace tactus::host
