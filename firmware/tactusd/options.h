// The command line of tactusd.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <optional>

#include "firmware/commands/scene_store.h"

namespace tactus::firmware {

// Where the sockets lie unless told otherwise.
inline constexpr const char* kRunFolder = "/run/tactus";

struct Options {
  const char* device = nullptr;
  const char* scene = nullptr;      // none: free space
  const char* record = nullptr;     // .mcap or .csv
  const char* flight_dir = ".";     // of what the flight recorder writes
  const char* run_dir = nullptr;    // of the sockets; none: kRunFolder
  const char* group = nullptr;      // of the command socket; none: the program's
  std::uint16_t udp_port = 0;       // JSON to this port of this machine; 0: none
  const char* histogram = nullptr;  // CSV, written at the end
  double seconds = 0.0;             // 0: until told to stop
  bool enable = false;              // home and enable without being asked
  bool allow_non_realtime = false;
  bool allow_inject = false;          // faults on command, for tests and drills
  bool allow_uncommissioned = false;  // force on a device whose motors nobody has checked
  bool allow_uncertified = false;     // a scene stiffer than the device's certificate
  int priority = 80;
  std::optional<int> cpu;                                        // the loop's processor; none: any
  std::size_t scene_memory_bytes = SceneStore::kMaxScene_bytes;  // the largest scene image
  double rate_hz = 0.0;                                          // 0: the device's own
  bool help = false;
};

void print_usage(std::FILE* file);

// False, after telling the user on stderr, if it cannot be understood.
bool parse_options(int argc, const char* const* argv, Options& options);

}  // namespace tactus::firmware
