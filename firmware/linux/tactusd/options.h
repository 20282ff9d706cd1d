// The command line of tactusd.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <optional>

#include "firmware/linux/commands/scene_store.h"

namespace tactus::firmware {

// The folder of the sockets without --run-dir.
inline constexpr const char* kRunFolder = "/run/tactus";

struct Options {
  const char* device = nullptr;
  const char* scene = nullptr;      // null: free space
  const char* record = nullptr;     // file name, .mcap or .csv; null: no recording
  const char* flight_dir = ".";     // folder for the flight recorder's files
  const char* run_dir = nullptr;    // folder for the sockets; null: kRunFolder
  const char* group = nullptr;      // group of the command socket; null: the program's own
  std::uint16_t udp_port = 0;       // port of this machine that gets JSON; 0: none
  const char* histogram = nullptr;  // CSV file, written at the end; null: none
  double seconds = 0.0;             // length of the run; 0: until a signal ends it
  bool enable = false;              // home and enable without an operator's request
  bool allow_non_realtime = false;
  bool allow_inject = false;          // accept injected faults, for tests and drills
  bool allow_uncommissioned = false;  // allow force on a device that was never commissioned
  bool allow_uncertified = false;     // allow a scene stiffer than the device's certificate
  int priority = 80;                  // SCHED_FIFO priority of the loop
  std::optional<int> cpu;             // processor of the loop; none: any
  std::size_t scene_memory_bytes = SceneStore::kMaxScene_bytes;  // size of the largest scene image
  double rate_hz = 0.0;                                          // 0: the rate in the device's file
  bool help = false;
};

void print_usage(std::FILE* file);

// Reads the command line into `options`. Returns false after it has printed why to stderr.
bool parse_options(int argc, const char* const* argv, Options& options);

}  // namespace tactus::firmware
