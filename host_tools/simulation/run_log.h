// The files that a run leaves: one line a tick.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "host_tools/files/output_file.h"
#include "host_tools/simulation/simulation.h"

namespace tactus::host {

// A text file, or a pipe, written in large pieces. The file is there under its name once close()
// has returned. Throws InputError, text for a user, when it cannot be written, or is a baked image.
class LogFile {
 public:
  LogFile(const std::filesystem::path& path, std::string_view header);

  // Returns the buffer to append the next line to; call `flush_if_full` afterwards.
  std::string& buffer() { return buffer_; }
  void flush_if_full();
  void close();

 private:
  void flush();

  OutputFile file_;
  std::string buffer_;
};

// run.csv. The first thirteen columns are those of `tactus touch`; contact is 0 or 1; mode
// and friction_state are numbers in the order of firmware::Mode and rendering::FrictionState,
// faults and limits are firmware::FaultBits, the hash is hexadecimal.
class RunCsv {
 public:
  explicit RunCsv(const std::filesystem::path& path);
  void add(const Simulation& simulation);
  void close() { file_.close(); }

 private:
  LogFile file_;
};

// One line a tick: tick,hash (hexadecimal).
class HashLog {
 public:
  explicit HashLog(const std::filesystem::path& path);
  void add(const firmware::TelemetryRecord& record);
  void close() { file_.close(); }

 private:
  LogFile file_;
};

}  // namespace tactus::host
