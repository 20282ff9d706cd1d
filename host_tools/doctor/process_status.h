// What /proc says of the process that asks: its limits, groups and capabilities.
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

// Of /proc/self/limits, soft; "unlimited" is the largest number. Nothing if it does not say.
std::optional<std::uint64_t> soft_limit(Machine& machine, std::string_view name);

// Of /proc/self/status.
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
