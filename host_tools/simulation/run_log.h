// The text files that a run leaves, with one line a tick: run.csv and the log of hashes. `tactus
// sim` and replay write them after each tick, outside of the controller.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "host_tools/files/output_file.h"
#include "host_tools/simulation/simulation.h"

namespace tactus::host {

// A text file or pipe that is written in large pieces. A file takes its name when close() returns.
// Throws InputError if it cannot be written, or if the name belongs to a baked image.
class LogFile {
 public:
  // Creates the file; `header` is its first line, newline included.
  LogFile(const std::filesystem::path& path, std::string_view header);

  // Returns the buffer to append the next line to; call `flush_if_full` afterwards.
  std::string& buffer() { return buffer_; }
  // Writes the buffer to the file if it is large.
  void flush_if_full();
  // Writes the rest and puts the file in its place.
  void close();

 private:
  void flush();

  OutputFile file_;
  std::string buffer_;
};

// run.csv, for plots and spreadsheets. Its columns are described in simulation/README.md.
// `contact`, `mode` and `friction_state` are numbers in the order of firmware::Mode and
// rendering::FrictionState; `faults` and `limits` are firmware::FaultBits; the hash is hexadecimal.
class RunCsv {
 public:
  explicit RunCsv(const std::filesystem::path& path);
  // Appends the last tick of a device.
  void add(const Simulation& simulation, std::size_t device = 0);
  void close() { file_.close(); }

 private:
  LogFile file_;
};

// A file with the columns tick and hash (hexadecimal). Two runs are equal if their files are.
class HashLog {
 public:
  explicit HashLog(const std::filesystem::path& path);
  void add(const firmware::TelemetryRecord& record);
  void close() { file_.close(); }

 private:
  LogFile file_;
};

}  // namespace tactus::host
