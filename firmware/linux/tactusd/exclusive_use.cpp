#include "firmware/linux/tactusd/exclusive_use.h"

#include <net/if.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cinttypes>
#include <cstdio>
#include <cstring>
#include <span>
#include <variant>

#include "firmware/linux/tactusd/messages.h"

namespace tactus::firmware {
namespace {

// Returns the text with a zero at its end, as system calls need it.
std::array<char, kMaxMessage> terminated(std::string_view text) {
  std::array<char, kMaxMessage> room{};
  std::ranges::copy(text.substr(0, room.size() - 1), room.begin());
  return room;
}

// Names a file by its device and inode, so that a link to it has the same name. Returns an empty
// name if there is no such file.
ClaimName file_claim(const char* kind, std::string_view path, unsigned channel = 0) {
  ClaimName name{};
  struct stat status{};
  if (::stat(terminated(path).data(), &status) != 0) {
    return name;
  }
  const bool is_device = S_ISCHR(status.st_mode);
  std::snprintf(name.data(), name.size(), "%s/%" PRIuMAX ":%" PRIuMAX "/%u", kind,
                static_cast<std::uintmax_t>(is_device ? status.st_rdev : status.st_dev),
                static_cast<std::uintmax_t>(is_device ? 0 : status.st_ino), channel);
  return name;
}

// Names a CAN interface by its number. Returns an empty name if there is none.
ClaimName can_claim(std::string_view interface) {
  ClaimName name{};
  const unsigned index = if_nametoindex(terminated(interface).data());
  if (index != 0) {
    std::snprintf(name.data(), name.size(), "can/%u", index);
  }
  return name;
}

}  // namespace

bool ExclusiveUse::take(std::string_view name, std::string_view what, std::string_view which) {
  const auto has_name = [name](const ClaimName& held) {
    return std::string_view(held.data()) == name;
  };
  if (name.empty() || std::ranges::any_of(std::span(names_).first(taken_), has_name)) {
    return true;
  }
  const hal::ClaimOutcome outcome = claims_[taken_].take(name);
  if (outcome.is_held) {
    std::ranges::copy(name, names_[taken_].begin());
    ++taken_;
    return true;
  }
  if (outcome.errno_value != EADDRINUSE) {
    std::fprintf(stderr, "tactusd: %.*s %.*s cannot be held for this program: %s\n", length(what),
                 what.data(), length(which), which.data(), std::strerror(outcome.errno_value));
  } else {
    std::fprintf(stderr,
                 "tactusd: %.*s %.*s is in use by another controller, process %d; end it with kill "
                 "%d, or name another\n",
                 length(what), what.data(), length(which), which.data(), outcome.holder,
                 outcome.holder);
  }
  return false;
}

bool ExclusiveUse::of_run_folder(const char* folder) {
  return take(file_claim("run", folder).data(), "the run folder", folder);
}

bool ExclusiveUse::of(const drivers::CanConnection& can) {
  return take(can_claim(can.interface).data(), "the CAN interface", can.interface);
}

bool ExclusiveUse::of(const drivers::HaplyConnection& haply) {
  return take(file_claim("serial", haply.port).data(), "the serial port", haply.port);
}

bool ExclusiveUse::of(const drivers::GpioConnection& gpio) {
  return take(file_claim("pwm", gpio.pwm_folder, gpio.pwm_channel).data(), "the PWM channel of",
              gpio.pwm_folder);
}

// The USB device is claimed by its opening.
bool ExclusiveUse::of(const drivers::FalconConnection& /*falcon*/) {
  return true;
}

bool ExclusiveUse::of_boards(const DeviceConfig& config) {
  return std::ranges::all_of(
      std::span(config.connections).first(config.connection_count),
      [this](const ConnectionConfig& connection) {
        return std::visit([this](const auto& line) { return this->of(line); }, connection.line);
      });
}

}  // namespace tactus::firmware
