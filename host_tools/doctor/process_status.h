// The limits, groups and capabilities of this process, read from /proc through Machine, so that
// they can be those of a recorded machine.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host_tools/doctor/machine.h"

namespace tactus::host {

// Bits of CapEff, from linux/capability.h: locking any amount of memory, and any real-time
// priority.
inline constexpr unsigned kCapabilityIpcLock = 14;
inline constexpr unsigned kCapabilitySysNice = 23;

// Returns a soft limit of /proc/self/limits, in the unit of that file, and the largest number for
// "unlimited"; nothing if the file does not list it.
std::optional<std::uint64_t> soft_limit(Machine& machine, std::string_view name);

// Returns true if /proc/self/status lists the capability as effective.
bool has_capability(Machine& machine, unsigned capability);
// Returns true if the effective user is root.
bool is_root(Machine& machine);
// Returns the numbers, as text, of this process's group and its further groups.
std::vector<std::string> group_numbers(Machine& machine);

// A line of /etc/group.
struct GroupEntry {
  std::string number;
  std::string members;  // separated by commas
};
// Returns the group's line of /etc/group; nothing if there is no such group.
std::optional<GroupEntry> group_entry(Machine& machine, std::string_view name);

}  // namespace tactus::host
