// The limits, groups and capabilities of this process, read from /proc.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host_tools/doctor/machine.h"

namespace tactus::host {

inline constexpr unsigned kCapabilityIpcLock = 14;  // linux/capability.h
inline constexpr unsigned kCapabilitySysNice = 23;

// Returns a soft limit of /proc/self/limits, the largest number for "unlimited"; nothing if the
// file does not list it.
std::optional<std::uint64_t> soft_limit(Machine& machine, std::string_view name);

// The next three functions read /proc/self/status.
bool has_capability(Machine& machine, unsigned capability);
bool is_root(Machine& machine);
std::vector<std::string> group_numbers(Machine& machine);

// A line of /etc/group.
struct GroupEntry {
  std::string number;
  std::string members;  // separated by commas
};
std::optional<GroupEntry> group_entry(Machine& machine, std::string_view name);

}  // namespace tactus::host
