// The file of `--explain`: one row for each thing that happened in a tick.
#pragma once

#include <cstddef>
#include <filesystem>

#include "host_tools/explain/explained_tick.h"
#include "host_tools/simulation/run_log.h"

namespace tactus::host {

// Writes explained ticks. README.md describes the columns.
class StepsCsv {
 public:
  // Creates the file. Throws InputError if that is not possible.
  explicit StepsCsv(const std::filesystem::path& path);

  // Appends the rows of a tick: moves with their planes, iterations, features, and the tick itself.
  void add(const ExplainedTick& tick);
  // Writes the rest and puts the file in its place.
  void close() { file_.close(); }

 private:
  LogFile file_;
};

}  // namespace tactus::host
