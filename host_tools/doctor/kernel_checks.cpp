#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string>
#include <string_view>

#include "host_tools/doctor/checks.h"
#include "host_tools/doctor/raspberry_pi.h"
#include "host_tools/install_command.h"

namespace tactus::host {

namespace {

// Returns the release in a text like "Linux version 6.1.0-18-rt-amd64 (debian-kernel@...".
std::string release_in(const std::string& version) {
  constexpr std::string_view kHead = "Linux version ";
  return version.starts_with(kHead)
             ? version.substr(kHead.size(), version.find(' ', kHead.size()) - kHead.size())
             : version;
}

// Returns the command that installs a real-time kernel for this machine. Old kernels do not tell
// their architecture in /proc/sys/kernel/arch; their release often does.
std::string install_real_time_kernel(Machine& machine, std::string_view release) {
  const std::string architecture = machine.text("/proc/sys/kernel/arch").value_or("");
  // Raspberry Pi OS has its own kernels. Their firmware starts the one that it is told.
  if (release.contains("rpi") && architecture.starts_with("armv")) {
    return "put the 64-bit Raspberry Pi OS on the card; a real-time kernel is in that one alone";
  }
  if (release.contains("rpi")) {
    return fmt::format("{} && {}", install_command("linux-image-rpi-v8-rt"),
                       add_firmware_line("kernel=kernel8_rt.img"));
  }
  std::string package = "linux-image-rt-amd64";
  if (architecture == "aarch64" || release.contains("arm64")) {
    package = "linux-image-rt-arm64";
  } else if (architecture.starts_with("arm") || release.contains("armmp")) {
    package = "linux-image-rt-armmp";
  }
  return install_command(package) + " && sudo reboot";
}

// Clock sources that are read from a register of the processor. Any other, such as hpet, is a
// device on a bus, whose read takes a microsecond or more. Earlier ones are preferred.
constexpr std::array<std::string_view, 6> kQuickClocks = {
    "tsc",      "arch_sys_counter", "kvm-clock", "riscv_clocksource", "hyperv_clocksource_tsc_page",
    "tsc-early"};

}  // namespace

void check_kernel(Machine& machine, Findings& findings) {
  const auto version = machine.text("/proc/version");
  if (!version) {
    findings.push_back({"kernel", FindingState::not_looked, "/proc/version cannot be read",
                        "mount -t proc proc /proc"});
    return;
  }
  const std::string release = release_in(*version);
  // Kernels with the out-of-tree patches say it in sysfs, all of them in their version.
  if (machine.text("/sys/kernel/realtime") == "1" || version->contains("PREEMPT_RT") ||
      version->contains("PREEMPT RT")) {
    findings.push_back(well("kernel", release + ", PREEMPT_RT"));
    return;
  }
  findings.push_back({"kernel", FindingState::mend,
                      release + " without PREEMPT_RT: a tick may be milliseconds late",
                      install_real_time_kernel(machine, release)});
}

void check_clock_source(Machine& machine, Findings& findings) {
  const std::string folder = "/sys/devices/system/clocksource/clocksource0/";
  const auto current = machine.text(folder + "current_clocksource");
  if (!current) {
    findings.push_back({"clock source", FindingState::not_looked,
                        folder + "current_clocksource cannot be read",
                        "mount -t sysfs sysfs /sys"});
    return;
  }
  if (std::ranges::find(kQuickClocks, *current) != kQuickClocks.end()) {
    findings.push_back(well("clock source", *current));
    return;
  }
  const std::string available =
      " " + machine.text(folder + "available_clocksource").value_or("") + " ";
  const auto* const better = std::ranges::find_if(kQuickClocks, [&](std::string_view clock) {
    return available.contains(fmt::format(" {} ", clock));
  });
  findings.push_back(
      {"clock source", FindingState::mend,
       fmt::format("{}: reading the time takes a microsecond or more", *current),
       better != kQuickClocks.end()
           ? fmt::format("echo {} | sudo tee {}current_clocksource", *better, folder)
           : "sudo dmesg | grep -i clocksource   # why the kernel gave up the processor's own"});
}

void check_real_time_throttling(Machine& machine, Findings& findings) {
  // The controller sleeps for most of a period, so any usual share is enough. A small share is
  // wrong: the kernel then stops the loop's thread in the middle of a tick.
  constexpr double kShareWanted = 0.9;
  const auto runtime_us = machine.text("/proc/sys/kernel/sched_rt_runtime_us");
  const auto period_us = machine.text("/proc/sys/kernel/sched_rt_period_us");
  if (!runtime_us || !period_us) {
    findings.push_back({"real-time throttling", FindingState::not_looked,
                        "/proc/sys/kernel/sched_rt_runtime_us cannot be read",
                        "mount -t proc proc /proc"});
    return;
  }
  if (runtime_us->starts_with('-')) {
    findings.push_back(well("real-time throttling", "off"));
    return;
  }
  const double share = std::strtod(runtime_us->c_str(), nullptr) /
                       std::max(std::strtod(period_us->c_str(), nullptr), 1.0);
  const std::string found =
      fmt::format("real-time threads may have {:.0f} % of a processor", 100.0 * share);
  if (share >= kShareWanted) {
    findings.push_back(well("real-time throttling", found));
  } else {
    findings.push_back({"real-time throttling", FindingState::mend, found,
                        fmt::format("sudo sysctl kernel.sched_rt_runtime_us={:.0f}",
                                    0.95 * std::strtod(period_us->c_str(), nullptr))});
  }
}

}  // namespace tactus::host
