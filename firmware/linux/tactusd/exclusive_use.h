// Makes sure that only one tactusd uses a run folder, CAN interface, serial port or PWM channel.
// (The kernel itself gives pins and USB devices to one program only.) If another program holds one
// of them, a message on stderr names it and its process. Not real time; one thread.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "firmware/device_file/device_config.h"
#include "hal/linux/exclusive_claim.h"
#include "rendering/limits.h"

namespace tactus::firmware {

// A claim's name, ended by a zero: as long as a claim's name may be.
using ClaimName = std::array<char, 100>;

// Claims resources until the end of the program. Claim them before any of them is opened.
class ExclusiveUse {
 public:
  // Claims the folder of the sockets. Returns false after it has printed why to stderr.
  bool of_run_folder(const char* folder);
  // Claims every connection of a device. One that does not exist is skipped, because opening it
  // reports that, and so is a bus that another device of this program has claimed. Returns false
  // after it has printed why to stderr.
  bool of_boards(const DeviceConfig& config);

 private:
  // These claim a connection of each kind.
  bool of(const drivers::CanConnection& can);
  bool of(const drivers::HaplyConnection& haply);
  bool of(const drivers::GpioConnection& gpio);
  static bool of(const drivers::FalconConnection& falcon);

  // Claims one name. `what` and `which` describe it in a message.
  bool take(std::string_view name, std::string_view what, std::string_view which);

  static constexpr std::size_t kMost = rendering::kMaxTools * (kMaxConnections + 1);

  std::array<hal::ExclusiveClaim, kMost> claims_;
  std::array<ClaimName, kMost> names_{};
  std::size_t taken_ = 0;
};

}  // namespace tactus::firmware
