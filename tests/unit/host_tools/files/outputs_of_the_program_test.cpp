// Tries to lose a file with every verb of the program that writes one.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "host_tools/files/atomic_file.h"
#include "tests/support/paths.h"
#include "tests/support/run_program.h"
#include "tests/unit/host_tools/bake/temporary_folder.h"

namespace tactus::host {
namespace {

using testing::contains;
using testing::Outcome;
using testing::TemporaryFolder;

class OutputsOfTheProgram : public ::testing::Test {
 protected:
  void SetUp() override {
    (void)folder.write("flat.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    (void)folder.write("scene.toml", "[[object]]\nname = \"flat\"\nmesh = \"flat.off\"\n");
    (void)folder.write("path.csv", "t_s,x_m,y_m,z_m\n0,0.2,0.2,0.1\n0.001,0.2,0.2,0.001\n");
    ASSERT_EQ(run("bake scene.toml").exit_code, 0);
    ASSERT_EQ(run("bake scene.toml -o other.tactus").exit_code, 0);
    ASSERT_EQ(run("touch scene.tactus --path path.csv -o run.csv").exit_code, 0);
  }

  Outcome run(const std::string& arguments) {
    return testing::run_program(folder.path(), arguments);
  }

  std::string content(const std::string& name) { return read_file(folder.path() / name); }

  // Expects that the file does not change, and that the program says why in one line.
  void expect_kept(const std::string& name, const std::string& arguments, std::string_view why) {
    const std::string before = content(name);
    const Outcome result = run(arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments << ": " << result.output;
    EXPECT_TRUE(contains(result.output, why)) << arguments;
    EXPECT_EQ(content(name), before) << arguments;
  }

  // Runs with files of at most a kilobyte, as on a full disk: writes fail with an error.
  Outcome run_on_a_full_disk(const std::string& arguments) {
    (void)folder.write("run.sh", "trap '' XFSZ; ulimit -f 1; exec '" +
                                     testing::built_program("tactus") + "' " + arguments);
    const std::string command =
        "cd '" + folder.path().string() + "' && bash run.sh >out.txt 2>&1; echo $? >code.txt";
    EXPECT_EQ(std::system(command.c_str()), 0);
    return {.exit_code = std::stoi(content("code.txt")), .output = content("out.txt")};
  }

  TemporaryFolder folder;
};

TEST_F(OutputsOfTheProgram, NeverReplaceAnInput) {
  expect_kept("scene.tactus", "touch scene.tactus --path path.csv -o scene.tactus", "is the input");
  expect_kept("path.csv", "touch scene.tactus --path path.csv -o path.csv", "is the input");
  expect_kept("path.csv", "sim scene.tactus --path path.csv -o path.csv", "is the input");
  expect_kept("scene.tactus", "sim scene.tactus --hashes scene.tactus", "is the input");
  expect_kept("scene.tactus", "sim scene.tactus --record scene.tactus", "is the input");
  expect_kept("scene.toml", "bake scene.toml -o scene.toml", "is the input");
  expect_kept("flat.off", "bake scene.toml -o flat.off", "is the input");
  expect_kept("path.csv", "fit path.csv -o path.csv", "is the input");
  expect_kept("path.csv", "friction --motion path.csv -o path.csv", "is the input");
}

TEST_F(OutputsOfTheProgram, KeepARecordingUnlessItMayBeOverwritten) {
  const std::string record = "sim scene.tactus --seconds 1 --record ";
  EXPECT_EQ(run(record + "kept.mcap").exit_code, 0);
  EXPECT_EQ(run(record + "two.2.csv --device falcon").exit_code, 0);
  expect_kept("kept.mcap", record + "kept.mcap",
              "kept.mcap: this file is there and is kept; name another, or say --overwrite");
  expect_kept("kept.mcap", record + "kept.mcap --serve --run-dir .", "is there and is kept");
  expect_kept("two.2.csv", record + "two.csv --device falcon --path path.csv --path path.csv",
              "two.2.csv: this file is there and is kept");
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "two.csv"));
  const std::string before = content("kept.mcap");
  EXPECT_EQ(run(record + "kept.mcap --device falcon --overwrite").exit_code, 0);
  EXPECT_NE(content("kept.mcap"), before);
}

TEST_F(OutputsOfTheProgram, ARecordingIsWhatItsNameSays) {
  for (const std::string name : {"run.txt", "run", "run.MCAP"}) {
    const Outcome result = run("sim scene.tactus --seconds 1 --record " + name);
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_TRUE(contains(result.output, name + ": the name of a recording ends in .mcap, or in "
                                               ".csv for a table"))
        << result.output;
    EXPECT_FALSE(std::filesystem::exists(folder.path() / name));
  }
}

TEST_F(OutputsOfTheProgram, NeverReplaceABakedImageByOtherThings) {
  expect_kept("other.tactus", "touch scene.tactus --path path.csv -o other.tactus",
              "is a baked image");
  expect_kept("other.tactus", "sim scene.tactus --seconds 0.01 -o other.tactus",
              "is a baked image");
  expect_kept("other.tactus", "friction --motion path.csv -o other.tactus", "is a baked image");
}

TEST_F(OutputsOfTheProgram, StayLinksAndDevices) {
  const auto link = folder.path() / "device.tactus";
  std::filesystem::create_symlink("/dev/zero", link);
  EXPECT_TRUE(contains(run("bake scene.toml -o device.tactus").output, "is a device"));
  EXPECT_TRUE(contains(run("bake scene.toml -o .").output, "is a folder"));
  EXPECT_TRUE(std::filesystem::is_symlink(link));
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/zero"));
}

TEST_F(OutputsOfTheProgram, GoIntoAPipeWhereRowsMakeSense) {
  const Outcome rows =
      run("touch scene.tactus --path path.csv -o /dev/stdout 2>/dev/null | tail -n 1");
  EXPECT_TRUE(rows.output.starts_with("0.001,0.2,0.2,0.001,")) << rows.output;
  const Outcome beside_steps =
      run("touch scene.tactus --path path.csv -o /dev/stdout --explain steps.csv 2>&1 | tail -n 2");
  EXPECT_TRUE(contains(beside_steps.output, "0.001,0.2,0.2,0.001,")) << beside_steps.output;
}

TEST_F(OutputsOfTheProgram, OnAFullDiskSayItAndLeaveTheOldFile) {
  std::string path = "t_s,x_m,y_m,z_m\n";
  for (int i = 0; i < 200; ++i) {
    path += std::to_string(0.001 * i) + ",0.2,0.2,0.1\n";
  }
  (void)folder.write("long.csv", path);
  for (const char* const arguments :
       {"touch scene.tactus --path long.csv -o run.csv", "sim scene.tactus --seconds 1 -o run.csv",
        "friction --motion long.csv -o run.csv",
        "sim scene.tactus --seconds 1 --overwrite --record run.csv"}) {
    const std::string before = content("run.csv");
    const Outcome result = run_on_a_full_disk(arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments;
    EXPECT_TRUE(contains(result.output, "run.csv: cannot write")) << arguments;
    EXPECT_EQ(content("run.csv"), before) << arguments;
  }
}

TEST_F(OutputsOfTheProgram, OfFiguresOnAFullDiskAreNotEmptyPictures) {
  for (const char* const arguments : {"plot run.csv --scene scene.tactus -o here",
                                      "friction --experiment presliding --figure here.png"}) {
    const Outcome result = run_on_a_full_disk(arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments;
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "here_force.png"));
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "here.png"));
  }
}

TEST_F(OutputsOfTheProgram, OnStandardOutputThatIsFullEndWithAnError) {
  const Outcome result = run("inspect scene.tactus >/dev/full 2>words.txt; echo $?");
  EXPECT_EQ(result.output, "2\n");
  EXPECT_TRUE(contains(content("words.txt"), "standard output cannot be written: No space left"));
  EXPECT_EQ(run("inspect scene.tactus >/dev/full 2>/dev/full; echo $?").output, "2\n");
}

TEST_F(OutputsOfTheProgram, RunNoCommands) {
  const Outcome plotted = run("plot run.csv --scene scene.tactus -o '|touch ran;'");
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "ran")) << plotted.output;
  std::filesystem::copy_file(folder.path() / "run.csv", folder.path() / "a\n!touch ran\n.csv");
  const Outcome named = run("plot 'a\n!touch ran\n.csv' --scene scene.tactus -o fine");
  EXPECT_EQ(named.exit_code, 0) << named.output;
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "ran")) << named.output;
}

}  // namespace
}  // namespace tactus::host
