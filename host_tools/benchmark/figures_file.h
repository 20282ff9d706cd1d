// A CSV file of benchmark figures, one row a measurement, that says on which machine they were
// taken.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "host_tools/benchmark/instruction_count.h"
#include "host_tools/benchmark/touch_benchmark.h"

namespace tactus::host {

// One row: what was touched, and how long it took.
struct TouchFigures {
  // The mesh's name, its triangles, the tool's radius, whether the surface has friction, and the
  // tool's motion: "hand" or "jumps" (workload.h).
  std::string mesh;
  std::size_t triangles = 0;
  double radius_m = 0.0;
  bool friction = true;
  std::string motion;
  TouchTiming timing;
  Lateness lateness;
  // The times of ticks after a sleep and with cold caches; empty if they were not measured.
  std::optional<SingleTimes> paced;
  std::optional<SingleTimes> cold;
  // Empty if instructions were not counted.
  std::optional<InstructionCount> instructions;
};

// Returns processor, cores, system, compiler, flags and date on one line.
std::string describe_machine();

// Appends rows to a file. A new file gets the column names first; the first row of every run is
// preceded by a line `# <machine>`, since another run may have been elsewhere.
class FiguresFile {
 public:
  // Throws InputError if the file has other columns or cannot be written.
  explicit FiguresFile(std::filesystem::path path);
  // Appends a row. Throws InputError if the file cannot be written.
  void append(const TouchFigures& figures);

 private:
  void write(const std::string& text);

  std::filesystem::path path_;
  // True once this run has written its line about the machine.
  bool described_ = false;
};

}  // namespace tactus::host
