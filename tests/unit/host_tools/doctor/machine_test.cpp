#include "host_tools/doctor/machine.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "host_tools/input_error.h"
#include "tests/unit/host_tools/doctor/recorded_machine.h"

namespace tactus::host {
namespace {

TEST(DoctorMachine, WhatWasSavedOfThisMachineIsExaminedTheSame) {
  const std::filesystem::path folder =
      std::filesystem::path(::testing::TempDir()) / "tactus_saved_machine";
  std::filesystem::remove_all(folder);
  Machine here;
  const Findings findings = examine(here, needs_of_any_device());
  here.save(folder);
  Machine there(folder);
  EXPECT_EQ(in_words(examine(there, needs_of_any_device())), in_words(findings));
  std::filesystem::remove_all(folder);
}

TEST(DoctorMachine, AFolderThatIsNoMachineIsRefused) {
  EXPECT_THROW(Machine(std::filesystem::path(::testing::TempDir()) / "tactus_no_such_folder"),
               InputError);
}

TEST(DoctorMachine, AFolderThatCannotBeWrittenIsSaidToBe) {
  Machine here;
  here.text("/proc/version");
  EXPECT_THROW(here.save("/proc/tactus"), InputError);
}

TEST(DoctorMachine, ARecordedMachineReadsNothingOfThisOne) {
  const RecordedMachine board;
  board.remove("proc/version");
  Machine machine(board.root());
  EXPECT_FALSE(machine.text("/proc/version"));
  EXPECT_FALSE(machine.writable("/dev/null"));
  EXPECT_FALSE(machine.text("/proc/self"));
}

TEST(DoctorMachine, JsonIsAnObjectALine) {
  const RecordedMachine board;
  board.change("tactus/access", "w /dev/gpiochip0", "- /dev/gpiochip0");
  const Findings findings = board.examine();
  std::istringstream lines(in_json(findings));
  std::size_t count = 0;
  for (std::string line; std::getline(lines, line); ++count) {
    const auto json = nlohmann::json::parse(line);
    EXPECT_EQ(json["check"], findings.at(count).check);
    EXPECT_EQ(json["state"], findings[count].state == FindingState::mend ? "mend" : "well");
    EXPECT_EQ(json["remedy"], findings[count].remedy);
  }
  EXPECT_EQ(count, findings.size());
}

}  // namespace
}  // namespace tactus::host
