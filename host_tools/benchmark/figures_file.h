// A file of benchmark figures, one row a measurement, that says on which machine they were taken.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "host_tools/benchmark/instruction_count.h"
#include "host_tools/benchmark/touch_benchmark.h"

namespace tactus::host {

struct TouchFigures {
  std::string mesh;
  std::size_t triangles = 0;
  double radius_m = 0.0;
  bool friction = true;
  TouchTiming timing;
  std::optional<InstructionCount> instructions;
};

// Processor, cores, system, compiler, flags and date, one line.
std::string describe_machine();

// Comma-separated values: the column names where the file is new, and at the first `append` a line
// `# <machine>`, because another run may have been elsewhere.
class FiguresFile {
 public:
  // Throws InputError when the file has other columns or cannot be written.
  explicit FiguresFile(std::filesystem::path path);
  void append(const TouchFigures& figures);

 private:
  void write(const std::string& text);

  std::filesystem::path path_;
  bool described_ = false;
};

}  // namespace tactus::host
