// The files of `tactus sim`: for each device its rows, hashes, recording and explanation, and for
// all the bodies.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>

#include "firmware/telemetry/record.h"
#include "host_tools/bake/scene/mapped_scene.h"
#include "host_tools/cli/progress_line.h"
#include "host_tools/explain/run_explanation.h"
#include "host_tools/simulation/run_log.h"
#include "host_tools/simulation/run_recording.h"
#include "host_tools/simulation/simulation.h"
#include "host_tools/touch/body_files.h"

namespace tactus::host {

// The names of the files of the first device; empty for those that are not wanted. The files of a
// second device are called run.2.csv, and so on.
struct SimFiles {
  std::string output;
  std::string hashes;
  std::string record;
  std::string explain;
  BodyFileNames bodies;
};

// Writes the outputs that the user asked for and shows the progress.
class SimOutputs {
 public:
  // Creates the files. The simulation and the scene must outlive the outputs. Throws InputError if
  // a file cannot be created.
  SimOutputs(const SimFiles& files, double seconds, Simulation& simulation,
             const MappedScene& scene);

  // Writes where the bodies are before a tick.
  void begin_tick(const Simulation& simulation);
  // Writes the last tick to every other output.
  void add(const Simulation& simulation);
  // Completes the outputs. Throws InputError if one cannot be written to its end.
  void close();

 private:
  // The outputs of one device.
  struct OfDevice {
    std::optional<RunCsv> rows;
    std::optional<HashLog> hashes;
    std::optional<RunRecording> recording;
    std::optional<RunExplanation> explanation;
  };

  double seconds_;
  // An explanation stays where the controller knows it.
  std::deque<OfDevice> devices_;
  BodyFiles bodies_;
  std::optional<ProgressLine> progress_;
};

}  // namespace tactus::host
