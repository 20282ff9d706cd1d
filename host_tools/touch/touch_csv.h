// The file that `tactus touch` writes, with one row a tick; `tactus compare` writes one a variant.
#pragma once

#include <filesystem>

#include "host_tools/simulation/run_log.h"
#include "rendering/touch.h"

namespace tactus::host {

// The columns are described by `tactus touch --help`.
class TouchCsv {
 public:
  // Throws InputError if the file cannot be written.
  explicit TouchCsv(const std::filesystem::path& path);
  // Appends a tick at the time t_s with the tool at tool_W (world frame, m).
  void add(double t_s, const Vec3& tool_W, const rendering::Touch& touch);
  // Puts the complete file in its place.
  void close() { file_.close(); }

 private:
  LogFile file_;
};

}  // namespace tactus::host
