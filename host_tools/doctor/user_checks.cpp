#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "host_tools/doctor/checks.h"
#include "host_tools/doctor/process_status.h"

namespace tactus::host {

namespace {

// The real-time priority of tactusd unless --priority changes it.
constexpr std::uint64_t kPriorityWanted = 80;
// tactusd locks itself and its scene. A scene of a million triangles has 100 MB; the program and
// its libraries are small against it.
constexpr std::uint64_t kLockedWanted_bytes = 256ULL << 20U;
// The group that owns devices and sockets; the limits installed with the service are put on it.
constexpr const char* kGroup = "tactus";
constexpr const char* kJoinGroup = "sudo usermod -aG tactus $USER   # then log in again";
constexpr const char* kInstallLimits =
    "sudo cmake --install build/release --prefix /usr && sudo usermod -aG tactus $USER   # then "
    "log in again";

// Reports that a file of /proc could not be read.
void not_known(Findings& findings, const char* check, const char* path) {
  findings.push_back({check, FindingState::not_looked, fmt::format("{} cannot be read", path),
                      "mount -t proc proc /proc"});
}

}  // namespace

void check_real_time_priority(Machine& machine, Findings& findings) {
  constexpr const char* kCheck = "real-time priority";
  const auto limit = soft_limit(machine, "Max realtime priority");
  if (!limit) {
    not_known(findings, kCheck, "/proc/self/limits");
  } else if (has_capability(machine, kCapabilitySysNice)) {
    findings.push_back(well(kCheck, "any (CAP_SYS_NICE)"));
  } else if (*limit >= kPriorityWanted) {
    findings.push_back(well(kCheck, fmt::format("up to {}", std::min<std::uint64_t>(*limit, 99))));
  } else {
    findings.push_back(
        {kCheck, FindingState::mend,
         *limit == 0 ? fmt::format("none permitted; the loop asks for {}", kPriorityWanted)
                     : fmt::format("up to {}; the loop asks for {}", *limit, kPriorityWanted),
         kInstallLimits});
  }
}

void check_locked_memory(Machine& machine, Findings& findings) {
  constexpr const char* kCheck = "locked memory";
  const auto limit = soft_limit(machine, "Max locked memory");
  if (!limit) {
    not_known(findings, kCheck, "/proc/self/limits");
  } else if (has_capability(machine, kCapabilityIpcLock) ||
             *limit == std::numeric_limits<std::uint64_t>::max()) {
    findings.push_back(well(kCheck, "unlimited"));
  } else if (*limit >= kLockedWanted_bytes) {
    findings.push_back(well(kCheck, fmt::format("up to {} MiB", *limit >> 20U)));
  } else {
    findings.push_back(
        {kCheck, FindingState::mend,
         fmt::format("up to {} KiB; the program locks itself and its scene whole", *limit >> 10U),
         kInstallLimits});
  }
}

void check_group(Machine& machine, Findings& findings) {
  constexpr const char* kCheck = "group tactus";
  if (!machine.text("/etc/group")) {
    not_known(findings, kCheck, "/etc/group");
    return;
  }
  const auto group = group_entry(machine, kGroup);
  const std::vector<std::string> joined = group_numbers(machine);
  if (is_root(machine)) {
    findings.push_back(well(kCheck, group ? "not needed by root" : "none; not needed by root"));
  } else if (!group) {
    findings.push_back({kCheck, FindingState::mend, "does not exist",
                        "sudo groupadd --system tactus && " + std::string(kJoinGroup)});
  } else if (std::ranges::find(joined, group->number) != joined.end()) {
    findings.push_back(well(kCheck, "joined"));
  } else {
    findings.push_back({kCheck, FindingState::mend,
                        "this login is not in it, so it may not reach devices or tactusd",
                        kJoinGroup});
  }
}

void check_cpu_latency(Machine& machine, Findings& findings) {
  constexpr const char* kCheck = "processor sleep";
  constexpr const char* kPath = "/dev/cpu_dma_latency";
  const auto writable = machine.writable(kPath);
  if (!writable) {
    findings.push_back({kCheck, FindingState::advice,
                        fmt::format("no {}: processors may sleep deeply between ticks", kPath),
                        "cat /sys/devices/system/cpu/cpuidle/current_driver   # \"none\" is well"});
  } else if (*writable) {
    findings.push_back(well(kCheck, fmt::format("{} may be held", kPath)));
  } else {
    findings.push_back(
        {kCheck, FindingState::mend,
         fmt::format("{} may not be written: processors sleep deeply between ticks", kPath),
         fmt::format("sudo chgrp tactus {} && sudo chmod g+rw {}", kPath, kPath)});
  }
}

}  // namespace tactus::host
