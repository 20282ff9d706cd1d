#include "tests/unit/host_tools/doctor/recorded_machine.h"

#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <sstream>
#include <utility>

namespace tactus::host {

namespace {

constexpr auto kWell = std::to_array<std::pair<std::string_view, std::string_view>>({
    {"proc/version",
     "Linux version 6.1.0-28-rt-arm64 (debian-kernel@lists.debian.org) (gcc-12) #1 SMP PREEMPT_RT "
     "Debian 6.1.119-1\n"},
    {"proc/self/limits",
     "Limit                     Soft Limit           Hard Limit           Units     \n"
     "Max locked memory         unlimited            unlimited            bytes     \n"
     "Max realtime priority     95                   95                   \n"},
    {"proc/self/status",
     "Name:\ttactus\nUid:\t1000\t1000\t1000\t1000\nGid:\t1000\t1000\t1000\t1000\n"
     "Groups:\t27 997 1000 \nCapEff:\t0000000000000000\n"},
    {"proc/swaps", "Filename\tType\tSize\tUsed\tPriority\n"},
    {"proc/sys/kernel/arch", "aarch64\n"},
    {"proc/sys/kernel/sched_rt_runtime_us", "950000\n"},
    {"proc/sys/kernel/sched_rt_period_us", "1000000\n"},
    {"proc/sys/vm/compact_unevictable_allowed", "0\n"},
    {"etc/group", "root:x:0:\ntactus-old:x:5:\ntactus:x:997:ada\nada:x:1000:\n"},
    {"sys/devices/system/clocksource/clocksource0/current_clocksource", "arch_sys_counter\n"},
    {"sys/devices/system/clocksource/clocksource0/available_clocksource", "arch_sys_counter \n"},
    {"sys/devices/system/cpu/online", "0-3\n"},
    {"sys/devices/system/cpu/isolated", "3\n"},
    {"sys/devices/system/cpu/cpufreq/policy0/scaling_governor", "performance\n"},
    {"sys/kernel/mm/transparent_hugepage/enabled", "always [madvise] never\n"},
    {"sys/class/net/lo/type", "772\n"},
    {"sys/class/net/can0/type", "280\n"},
    {"sys/class/net/can0/flags", "0x40081\n"},
    {"sys/class/net/can0/mtu", "16\n"},
    {"tactus/ip_link_can0.json",
     R"([{"ifindex":3,"ifname":"can0","flags":["NOARP","UP","LOWER_UP","ECHO"],"mtu":16,)"
     R"("operstate":"UP","link_type":"can","linkinfo":{"info_kind":"can","info_data":)"
     R"({"state":"ERROR-ACTIVE","restart_ms":0,"bittiming":{"bitrate":1000000,)"
     R"("sample_point":"0.750"},"clock":80000000}}}])"},
    {"sys/bus/usb/devices/1-1.2/idVendor", "0403\n"},
    {"sys/bus/usb/devices/1-1.2/idProduct", "cb48\n"},
    {"sys/bus/usb/devices/1-1.2/busnum", "1\n"},
    {"sys/bus/usb/devices/1-1.2/devnum", "5\n"},
    {"sys/bus/usb/devices/usb1/idVendor", "1d6b\n"},
    {"sys/bus/gpio/devices/gpiochip0/uevent", "\n"},
    {"tactus/access", "w /dev/cpu_dma_latency\nw /dev/bus/usb/001/005\nw /dev/gpiochip0\n"},
    {"tactus/gpio_chips", "gpiochip0 pinctrl-bcm2711\n"},
    {"tactus/unit_cost_ns", "20\n"},
});

}  // namespace

RecordedMachine::RecordedMachine() {
  const auto* const test = ::testing::UnitTest::GetInstance()->current_test_info();
  root_ = std::filesystem::path(::testing::TempDir()) /
          (std::string("tactus_") + test->test_suite_name() + "_" + test->name());
  std::filesystem::remove_all(root_);
  for (const auto& [path, text] : kWell) {
    write(path, text);
  }
}

RecordedMachine::~RecordedMachine() {
  std::error_code ignored;
  std::filesystem::remove_all(root_, ignored);
}

void RecordedMachine::write(std::string_view path, std::string_view text) const {
  std::filesystem::create_directories((root_ / path).parent_path());
  std::ofstream(root_ / path, std::ios::binary) << text;
}

void RecordedMachine::remove(std::string_view path) const {
  EXPECT_GT(std::filesystem::remove_all(root_ / path), 0U) << path;
}

void RecordedMachine::change(std::string_view path, std::string_view from,
                             std::string_view to) const {
  std::ostringstream whole;
  whole << std::ifstream(root_ / path).rdbuf();
  std::string text = std::move(whole).str();
  const std::size_t at = text.find(from);
  if (at == std::string::npos) {
    ADD_FAILURE() << path << " has no " << from;
    return;
  }
  text.replace(at, from.size(), to);
  write(path, text);
}

Findings RecordedMachine::examine(const Needs& needs) const {
  Machine machine(root_);
  return host::examine(machine, needs);
}

Finding RecordedMachine::finding(std::string_view check, const Needs& needs) const {
  Findings same;
  for (const Finding& finding : examine(needs)) {
    if (finding.check == check) {
      same.push_back(finding);
    }
  }
  EXPECT_EQ(same.size(), 1U) << check;
  return same.size() == 1 ? same.front() : Finding{};
}

}  // namespace tactus::host
