// The command line of tactusd.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <optional>

#include "firmware/linux/commands/scene_store.h"
#include "rendering/limits.h"

namespace tactus::firmware {

// The folder of the sockets without --run-dir.
inline constexpr const char* kRunFolder = "/run/tactus";

// The options as given, with their defaults. The texts point into the command line.
struct Options {
  // The images of the devices, in the order in which they were given, and their number.
  std::array<const char*, rendering::kMaxTools> devices{};
  std::size_t device_count = 0;
  // The scene image; null: free space.
  const char* scene = nullptr;
  // The file of the first device's recording, .mcap or .csv; null: no recording.
  const char* record = nullptr;
  // True: a recording may replace a file that is there.
  bool overwrite = false;
  // The folder for the flight recorder's files.
  const char* flight_dir = ".";
  // The folder for the sockets of the first device; null: kRunFolder.
  const char* run_dir = nullptr;
  // The group of the command socket; null: the program's own.
  const char* group = nullptr;
  // The port of this machine that gets JSON of the first device, and the next one that of the
  // second; 0: none.
  std::uint16_t udp_port = 0;
  // The CSV file that is written at the end; null: none.
  const char* histogram = nullptr;
  // The length of the run; 0: until a signal ends it.
  double seconds = 0.0;
  // True: home and enable without an operator's request.
  bool enable = false;
  // True: run without real-time priority and locked memory.
  bool allow_non_realtime = false;
  // True: accept injected faults, for tests and drills.
  bool allow_inject = false;
  // True: allow force on a device that was never commissioned.
  bool allow_uncommissioned = false;
  // True: allow a scene that is stiffer than the device's certificate.
  bool allow_uncertified = false;
  // The SCHED_FIFO priority of the loop.
  int priority = 80;
  // The processor of the loop; none: any.
  std::optional<int> cpu;
  // The size of the largest scene image.
  std::size_t scene_memory_bytes = SceneStore::kMaxScene_bytes;
  // The number of ticks a second; 0: the rate in the device's file.
  double rate_hz = 0.0;
  // True: print the usage and end.
  bool help = false;
  // True: print the version and end.
  bool version = false;
};

// Prints the usage with examples.
void print_usage(std::FILE* file);

// Reads the command line into `options`, and from each image whether it is a scene's. Returns false
// after it has printed why to stderr.
bool parse_options(int argc, const char* const* argv, Options& options);

}  // namespace tactus::firmware
