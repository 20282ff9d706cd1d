#include <gtest/gtest.h>

#include <string>

#include "tests/unit/host_tools/doctor/recorded_machine.h"

namespace tactus::host {
namespace {

// Expects a finding to be mended by a command that contains `command`.
void expect_to_mend(const Finding& finding, const std::string& command) {
  EXPECT_EQ(finding.state, FindingState::mend) << finding.found;
  EXPECT_TRUE(finding.remedy.contains(command)) << finding.remedy;
}

TEST(Doctor, AWellSetUpBoardIsReady) {
  const RecordedMachine board;
  const Findings findings = board.examine();
  for (const Finding& finding : findings) {
    EXPECT_EQ(finding.state, FindingState::well) << finding.check << ": " << finding.found;
    EXPECT_EQ(finding.remedy, "") << finding.check;
  }
  EXPECT_EQ(exit_code(findings), 0);
  EXPECT_TRUE(in_words(findings).ends_with("ready for real time\n"));
}

TEST(Doctor, AKernelWithoutRealTimeIsToBeReplacedByTheOneForItsProcessor) {
  const RecordedMachine board;
  board.change("proc/version", "PREEMPT_RT", "PREEMPT_DYNAMIC");
  expect_to_mend(board.finding("kernel"), "install linux-image-rt-arm64");
  board.write("proc/sys/kernel/arch", "x86_64\n");
  board.change("proc/version", "rt-arm64", "amd64");
  expect_to_mend(board.finding("kernel"), "install linux-image-rt-amd64");
  EXPECT_EQ(exit_code(board.examine()), 1);
}

TEST(Doctor, RaspberryPiOsHasARealTimeKernelOfItsOwn) {
  const RecordedMachine board;
  board.write("proc/version", "Linux version 6.12.25+rpt-rpi-v8 (serge@raspberrypi.com) #1 SMP\n");
  expect_to_mend(board.finding("kernel"), "install linux-image-rpi-v8-rt");
  expect_to_mend(board.finding("kernel"), "kernel=kernel8_rt.img");
  board.write("proc/sys/kernel/arch", "armv7l\n");
  expect_to_mend(board.finding("kernel"), "64-bit Raspberry Pi OS");
}

// 2 million instructions are 18,181 cost units.
TEST(Doctor, ATickThatTheProcessorIsTooSlowForIsToBeMadeSmaller) {
  const RecordedMachine board;
  const Finding fast = board.finding("tick budget");
  EXPECT_EQ(fast.state, FindingState::well);
  EXPECT_EQ(fast.found, "2 million instructions take up to 0.36 of 1.00 ms");
  board.write("tactus/unit_cost_ns", "30\n");
  EXPECT_EQ(board.finding("tick budget").state, FindingState::advice) << "0.55 ms";
  board.write("tactus/unit_cost_ns", "110\n");
  expect_to_mend(board.finding("tick budget"), "tick_instructions = 500000 below [controller]");
  Needs fewer = needs_of_any_device();
  fewer.tick_instructions = 5e5;
  EXPECT_EQ(board.finding("tick budget", fewer).state, FindingState::well);
  board.remove("tactus/unit_cost_ns");
  EXPECT_EQ(board.finding("tick budget").state, FindingState::not_looked);
}

TEST(Doctor, AKernelThatSaysItInSysfsIsARealTimeKernel) {
  const RecordedMachine board;
  board.change("proc/version", "PREEMPT_RT", "PREEMPT");
  board.write("sys/kernel/realtime", "1\n");
  EXPECT_EQ(board.finding("kernel").state, FindingState::well);
}

TEST(Doctor, PriorityAndLockedMemoryComeFromTheLimitsOrFromCapabilities) {
  const RecordedMachine board;
  board.change("proc/self/limits", "95  ", "0  ");
  board.change("proc/self/limits", "unlimited", "8388608  ");
  expect_to_mend(board.finding("real-time priority"), "usermod -aG tactus");
  expect_to_mend(board.finding("locked memory"), "usermod -aG tactus");
  EXPECT_TRUE(board.finding("locked memory").found.contains("8192 KiB"));

  board.change("proc/self/status", "CapEff:\t0000000000000000", "CapEff:\t0000000000804000");
  EXPECT_EQ(board.finding("real-time priority").state, FindingState::well);
  EXPECT_EQ(board.finding("locked memory").state, FindingState::well);
}

TEST(Doctor, APriorityBelowTheLoopsIsToBeMended) {
  const RecordedMachine board;
  board.change("proc/self/limits", "95", "79");
  EXPECT_EQ(board.finding("real-time priority").state, FindingState::mend);
  board.change("proc/self/limits", "79", "80");
  EXPECT_EQ(board.finding("real-time priority").state, FindingState::well);
}

TEST(Doctor, AGroupIsMissingOrNotJoined) {
  const RecordedMachine board;
  board.change("proc/self/status", "27 997 1000", "27 1000");
  expect_to_mend(board.finding("group tactus"), "sudo usermod -aG tactus $USER");
  board.change("etc/group", "tactus:x:997:ada\n", "");
  expect_to_mend(board.finding("group tactus"), "sudo groupadd --system tactus");
  board.change("proc/self/status", "Uid:\t1000\t1000", "Uid:\t0\t0");
  EXPECT_EQ(board.finding("group tactus").state, FindingState::well);
}

TEST(Doctor, ProcessorsThatSleepDeeplyAreToBeKeptAwake) {
  const RecordedMachine board;
  board.change("tactus/access", "w /dev/cpu_dma_latency", "- /dev/cpu_dma_latency");
  expect_to_mend(board.finding("processor sleep"), "sudo chgrp tactus /dev/cpu_dma_latency");
  board.change("tactus/access", "- /dev/cpu_dma_latency\n", "");
  EXPECT_EQ(board.finding("processor sleep").state, FindingState::advice);
}

TEST(Doctor, ASlowClockIsToBeLeftForAQuickOne) {
  const RecordedMachine board;
  const std::string folder = "sys/devices/system/clocksource/clocksource0/";
  board.write(folder + "current_clocksource", "hpet\n");
  board.write(folder + "available_clocksource", "hpet acpi_pm \n");
  expect_to_mend(board.finding("clock source"), "sudo dmesg");
  board.write(folder + "available_clocksource", "tsc hpet acpi_pm \n");
  expect_to_mend(board.finding("clock source"),
                 "echo tsc | sudo tee /sys/devices/system/clocksource/clocksource0/current");
}

TEST(Doctor, OneProcessorThatSavesPowerIsToBeMended) {
  const RecordedMachine board;
  board.write("sys/devices/system/cpu/cpufreq/policy2/scaling_governor", "schedutil\n");
  const Finding finding = board.finding("frequency governor");
  expect_to_mend(finding, "echo performance | sudo tee");
  EXPECT_TRUE(finding.found.starts_with("schedutil:")) << finding.found;
}

TEST(Doctor, TheLastProcessorIsProposedForTheLoop) {
  const RecordedMachine board;
  board.write("sys/devices/system/cpu/isolated", "\n");
  const Finding finding = board.finding("isolated processors");
  EXPECT_EQ(finding.state, FindingState::advice);
  EXPECT_TRUE(finding.remedy.contains("isolcpus=3 ")) << finding.remedy;
  board.write("sys/devices/system/cpu/online", "0\n");
  EXPECT_EQ(board.finding("isolated processors").state, FindingState::well);
}

TEST(Doctor, ARaspberryPiIsolatesItInTheFileOfItsFirmware) {
  const RecordedMachine board;
  board.write("sys/devices/system/cpu/isolated", "\n");
  board.write("proc/device-tree/model", std::string("Raspberry Pi 4 Model B Rev 1.5") + '\0');
  EXPECT_EQ(board.finding("isolated processors").remedy,
            "sudo sed -i '1s/$/ isolcpus=3 nohz_full=3 rcu_nocbs=3/' /boot/firmware/cmdline.txt && "
            "sudo reboot");
}

TEST(Doctor, ABoardThatMeasuresItsSupplyTellsLowVoltage) {
  const RecordedMachine board;
  board.write("sys/class/hwmon/hwmon0/name", "cpu_thermal\n");
  board.write("sys/class/hwmon/hwmon1/name", "rpi_volt\n");
  board.write("sys/class/hwmon/hwmon1/in0_lcrit_alarm", "0\n");
  EXPECT_EQ(board.finding("power supply").state, FindingState::well);
  board.write("sys/class/hwmon/hwmon1/in0_lcrit_alarm", "1\n");
  expect_to_mend(board.finding("power supply"), "dmesg");
}

TEST(Doctor, ThrottlingMattersWhenItTakesTheUsualShare) {
  const RecordedMachine board;
  board.write("proc/sys/kernel/sched_rt_runtime_us", "100000\n");
  expect_to_mend(board.finding("real-time throttling"),
                 "sudo sysctl kernel.sched_rt_runtime_us=950000");
  board.write("proc/sys/kernel/sched_rt_runtime_us", "-1\n");
  EXPECT_EQ(board.finding("real-time throttling").found, "off");
}

TEST(Doctor, AdviceDoesNotFailAMachine) {
  const RecordedMachine board;
  board.write("sys/kernel/mm/transparent_hugepage/enabled", "[always] madvise never\n");
  board.write("proc/sys/vm/compact_unevictable_allowed", "1\n");
  board.write("proc/swaps", "Filename\tType\n/dev/sda2\tpartition\n");
  for (const char* check : {"transparent huge pages", "memory compaction", "swap"}) {
    const Finding finding = board.finding(check);
    EXPECT_EQ(finding.state, FindingState::advice) << check;
    EXPECT_NE(finding.remedy, "") << check;
  }
  EXPECT_EQ(exit_code(board.examine()), 0);
}

TEST(Doctor, WhatCannotBeReadIsSaidNotToBeKnown) {
  const RecordedMachine board;
  board.remove("proc/self");
  EXPECT_EQ(board.finding("real-time priority").state, FindingState::not_looked);
  EXPECT_EQ(board.finding("locked memory").state, FindingState::not_looked);
  EXPECT_EQ(board.finding("kernel").state, FindingState::well);
  board.write("proc/self/status", "Groups:\t997\n");
  EXPECT_EQ(exit_code(board.examine()), 2);
  board.remove("proc/version");
  board.change("sys/devices/system/cpu/cpufreq/policy0/scaling_governor", "performance",
               "powersave");
  EXPECT_EQ(exit_code(board.examine()), 1);
}

TEST(Doctor, EveryFindingThatIsNotWellNamesARemedyAndEveryEmptyMachineIsSurvived) {
  const RecordedMachine board;
  for (const char* folder : {"etc", "sys", "tactus", "proc"}) {
    board.remove(folder);
  }
  board.write("proc/empty", "");
  for (const Finding& finding : board.examine()) {
    EXPECT_EQ(finding.remedy.empty(), finding.state == FindingState::well) << finding.check;
  }
}

}  // namespace
}  // namespace tactus::host
