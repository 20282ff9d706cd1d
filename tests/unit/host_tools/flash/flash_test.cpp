#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "host_tools/flash/board_program.h"
#include "host_tools/flash/emulated_board.h"
#include "host_tools/flash/emulator_pace.h"
#include "host_tools/flash/flash_tool.h"
#include "host_tools/input_error.h"
#include "tests/support/folder_test.h"
#include "tests/support/run_program.h"

namespace tactus::host {
namespace {

// The first bytes of an ELF file of 32 bits, little-endian, for a processor of that number.
std::string elf_for(char processor) {
  std::string bytes =
      "\x7f"
      "ELF\x01\x01\x01";
  bytes.resize(18, '\0');
  return bytes + processor + '\0' + std::string(32, '\0');
}

constexpr char kArmProcessor = 40;
constexpr char kPcProcessor = 62;

class FlashTest : public FolderTest {
 protected:
  std::string write_file(const std::string& name, const std::string& content) {
    std::ofstream(file(name), std::ios::binary) << content;
    return file(name);
  }
  // A shell script that the verb can call as a tool.
  std::string write_tool(const std::string& name, const std::string& lines) {
    const std::string path = write_file(name, "#!/bin/sh\n" + lines + "\n");
    std::filesystem::permissions(path, std::filesystem::perms::owner_all);
    return path;
  }
  // The text of the error with which a plan is refused.
  static std::string plan_refusal(const FlashPlan& plan) {
    try {
      flash_command(plan);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
};

TEST_F(FlashTest, OpenocdWritesVerifiesAndRestarts) {
  const std::string program = write_file("board.elf", elf_for(kArmProcessor));
  EXPECT_EQ(flash_command({.program = program, .configs = {"a.cfg", "b c.cfg"}}),
            "openocd -f 'a.cfg' -f 'b c.cfg' -c 'program {" + program + "} verify reset exit'");
}

TEST_F(FlashTest, AToolOfTheUserGetsTheQuotedFileInEveryPlace) {
  const std::string program = write_file("my board.hex", ":00000001FF");
  EXPECT_EQ(flash_command({.program = program, .with = "tool {file} --log={file}.log"}),
            "tool '" + program + "' --log='" + program + "'.log");
}

TEST_F(FlashTest, WithoutAToolOrAPlaceForTheFileThePlanIsRefusedWithAnExample) {
  const std::string program = write_file("board.elf", elf_for(kArmProcessor));
  EXPECT_NE(plan_refusal({.program = program}).find("--config interface/"), std::string::npos);
  EXPECT_NE(plan_refusal({.program = program, .with = "tool"}).find("write {file}"),
            std::string::npos);
  EXPECT_NE(plan_refusal({.program = program, .configs = {"a"}, .with = "t {file}"}).find("one"),
            std::string::npos);
}

TEST_F(FlashTest, AFileThatIsNoProgramForABoardIsRefusedWithTheRemedy) {
  const auto refusal = [](const std::string& program) {
    return plan_refusal({.program = program, .configs = {"board.cfg"}});
  };
  EXPECT_NE(refusal(file("none")).find("run.sh --build"), std::string::npos);
  EXPECT_NE(refusal(folder()).find("a folder"), std::string::npos);
  EXPECT_NE(refusal(write_file("x.hex", ":10")).find("--with"), std::string::npos);
  EXPECT_NE(refusal(write_file("pc", elf_for(kPcProcessor))).find("preset cortex-m7"),
            std::string::npos);
  EXPECT_NE(refusal(write_file("cut",
                               "\x7f"
                               "ELF"))
                .find("preset cortex-m7"),
            std::string::npos);
}

TEST_F(FlashTest, AToolIsFoundInTheFoldersOfThePathOnly) {
  write_tool("probe", "true");
  write_file("text", "x");
  EXPECT_EQ(find_tool("probe", "/nowhere:" + std::string(folder())), file("probe"));
  EXPECT_EQ(find_tool("text", folder()), "");
  EXPECT_EQ(find_tool("probe", "/nowhere"), "");
  EXPECT_EQ(find_tool(file("probe"), ""), file("probe"));
}

TEST_F(FlashTest, TheEmulatorHasTheClockOfTheBoard) {
  const auto command = emulator_command({.program = "p", .line = "a.sock"});
  std::string all;
  for (const std::string& word : command) {
    all += word + ' ';
  }
  EXPECT_NE(all.find("-serial stdio "), std::string::npos) << all;
  EXPECT_NE(all.find("-icount shift=1,sleep=off "), std::string::npos) << all;
}

TEST_F(FlashTest, TheBoardsTimeIsReadBehindTheEchoOfTheQuestion) {
  EXPECT_EQ(word_of_monitor("x\x1b[K\x1b[Dxp /1wx 0x40028018\x1b[K\r\n0000000040028018: "
                            "0x0a342a7a\r\n(qemu) "),
            0x0a342a7aU);
  EXPECT_FALSE(word_of_monitor("QEMU 7.2.22 monitor - type 'help' for more\r\n(qemu) "));
  EXPECT_FALSE(word_of_monitor("stop\x1b[K\r\n(qemu) "));
}

TEST_F(FlashTest, TheVerbsExitCodeTellsWhetherTheProgramIsOnTheBoard) {
  write_file("board.elf", elf_for(kArmProcessor));
  write_tool("good", "cp \"$1\" written; echo 100 %");
  write_tool("bad", "echo no probe; exit 3");

  auto outcome = testing::run_program(folder(), "flash board.elf --with './good {file}'");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_NE(outcome.output.find("100 %"), std::string::npos) << outcome.output;
  EXPECT_TRUE(std::filesystem::exists(file("written")));

  outcome = testing::run_program(folder(), "flash board.elf --with './bad {file}'");
  EXPECT_EQ(outcome.exit_code, 1) << outcome.output;
  EXPECT_NE(outcome.output.find("was not written"), std::string::npos) << outcome.output;

  outcome = testing::run_program(folder(), "flash board.elf --with './missing {file}'");
  EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
  EXPECT_NE(outcome.output.find("there is no such program"), std::string::npos) << outcome.output;
}

TEST_F(FlashTest, ADryRunPrintsTheCommandAndRunsNothing) {
  write_file("board.elf", elf_for(kArmProcessor));
  write_tool("good", "cp \"$1\" written");
  const auto outcome =
      testing::run_program(folder(), "flash board.elf --with './good {file}' --dry-run");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.output, "./good 'board.elf'\n");
  EXPECT_FALSE(std::filesystem::exists(file("written")));
}

TEST_F(FlashTest, ALineThatIsThereAlreadyIsNotTakenFromAnotherEmulator) {
  write_file("board.elf", elf_for(kArmProcessor));
  write_file("board.sock", "");
  if (find_tool("qemu-system-arm").empty()) {
    GTEST_SKIP() << "there is no qemu-system-arm";
  }
  try {
    run_emulated_board({.program = file("board.elf"), .line = file("board.sock")}, [] {});
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("it is there already"), std::string::npos);
  }
  EXPECT_TRUE(std::filesystem::exists(file("board.sock")));
}

}  // namespace
}  // namespace tactus::host
