#include <fmt/format.h>

#include <charconv>
#include <set>
#include <string>
#include <string_view>

#include "host_tools/doctor/checks.h"
#include "host_tools/doctor/raspberry_pi.h"

namespace tactus::host {

namespace {

constexpr const char* kCpus = "/sys/devices/system/cpu/";

// Returns the highest number of a list like "0-3" or "0,2"; the kernel writes them in order.
// Processor 0 usually serves interrupts, so the last one is the best to isolate.
unsigned last_processor(std::string_view online) {
  const std::size_t at = online.find_last_of("-,");
  const std::string_view last = at == std::string_view::npos ? online : online.substr(at + 1);
  unsigned number = 0;
  std::from_chars(last.data(), last.data() + last.size(), number);
  return number;
}

}  // namespace

void check_isolated_processors(Machine& machine, Findings& findings) {
  constexpr const char* kCheck = "isolated processors";
  const auto online = machine.text(std::string(kCpus) + "online");
  if (!online) {
    findings.push_back({kCheck, FindingState::not_looked,
                        std::string(kCpus) + "online cannot be read", "mount -t sysfs sysfs /sys"});
    return;
  }
  const std::string isolated = machine.text(std::string(kCpus) + "isolated").value_or("");
  const unsigned last = last_processor(*online);
  if (!isolated.empty()) {
    findings.push_back(well(kCheck, fmt::format("{} of {}", isolated, *online)));
  } else if (last == 0) {
    findings.push_back(well(kCheck, "none; there is one processor"));
  } else {
    const std::string words = fmt::format("isolcpus={0} nohz_full={0} rcu_nocbs={0}", last);
    findings.push_back(
        {kCheck, FindingState::advice, "none: other programs may run where the loop does",
         is_raspberry_pi(machine)
             ? add_kernel_words(words)
             : fmt::format("add {} to GRUB_CMDLINE_LINUX in /etc/default/grub, then sudo "
                           "update-grub && sudo reboot",
                           words)});
  }
}

void check_frequency_governor(Machine& machine, Findings& findings) {
  constexpr const char* kCheck = "frequency governor";
  std::set<std::string> others;
  std::size_t processors = 0;
  for (const std::string& policy : machine.names(std::string(kCpus) + "cpufreq")) {
    const auto governor = machine.text(fmt::format("{}cpufreq/{}/scaling_governor", kCpus, policy));
    processors += governor ? 1U : 0U;
    if (governor && *governor != "performance") {
      others.insert(*governor);
    }
  }
  if (processors == 0) {
    findings.push_back(well(kCheck, "none; the frequency is not Linux's to change"));
  } else if (others.empty()) {
    findings.push_back(well(kCheck, "performance"));
  } else {
    findings.push_back(
        {kCheck, FindingState::mend,
         fmt::format("{}: a tick after a quiet time is computed slowly", fmt::join(others, ", ")),
         fmt::format("echo performance | sudo tee {}cpufreq/policy*/scaling_governor", kCpus)});
  }
}

void check_huge_pages(Machine& machine, Findings& findings) {
  constexpr const char* kCheck = "transparent huge pages";
  constexpr const char* kPath = "/sys/kernel/mm/transparent_hugepage/enabled";
  const auto choice = machine.text(kPath);
  if (!choice || !choice->contains("[always]")) {
    findings.push_back(well(kCheck, choice ? "only where asked for" : "not in this kernel"));
    return;
  }
  findings.push_back({kCheck, FindingState::advice,
                      "always: the kernel stops a process to put its pages together",
                      fmt::format("echo madvise | sudo tee {}", kPath)});
}

void check_compaction(Machine& machine, Findings& findings) {
  constexpr const char* kCheck = "memory compaction";
  const auto moves = machine.text("/proc/sys/vm/compact_unevictable_allowed");
  if (moves.value_or("0") == "0") {
    findings.push_back(well(kCheck, "leaves locked memory alone"));
  } else {
    findings.push_back({kCheck, FindingState::advice,
                        "moves locked memory: a tick that touches it meanwhile waits",
                        "sudo sysctl vm.compact_unevictable_allowed=0"});
  }
}

void check_swap(Machine& machine, Findings& findings) {
  const auto swaps = machine.text("/proc/swaps");
  // One line is the header.
  if (!swaps || !swaps->contains('\n')) {
    findings.push_back(well("swap", swaps ? "off" : "not in this kernel"));
  } else {
    findings.push_back({"swap", FindingState::advice,
                        "on: what the loop locked stays, what serves it beside may be swapped out",
                        "sudo swapoff -a"});
  }
}

}  // namespace tactus::host
