// The course of the lectures: every command of its README runs, every picture is made, and the
// figures that the README names are those of the program.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "host_tools/files/atomic_file.h"
#include "tests/support/folder_test.h"
#include "tests/support/paths.h"
#include "tests/support/run_program.h"

namespace tactus::host {
namespace {

namespace fs = std::filesystem;

const fs::path kCourse = testing::in_repository("host_tools/examples/course");

// A copy of the examples, in which the commands may write.
class Course : public FolderTest {
 protected:
  Course() {
    fs::copy(kCourse.parent_path(), file("examples"), fs::copy_options::recursive);
    fs::remove_all(folder_of_course() / "out");
  }
  [[nodiscard]] fs::path folder_of_course() const { return fs::path(file("examples")) / "course"; }

  // Returns the runs of a comparison that is made in the course's folder.
  [[nodiscard]] nlohmann::json compared(const std::string& arguments) const {
    const testing::Outcome outcome =
        testing::run_program(folder_of_course(), "compare " + arguments + " --json");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
    return nlohmann::json::parse(outcome.output)["runs"];
  }
};

// Returns every match of the expression's first group.
std::vector<std::string> all_of(const std::string& text, const std::string& expression) {
  const std::regex pattern(expression);
  std::vector<std::string> found;
  for (std::sregex_iterator match(text.begin(), text.end(), pattern);
       match != std::sregex_iterator(); ++match) {
    found.push_back((*match)[1]);
  }
  return found;
}

TEST_F(Course, RunsWholeAndMakesThePicturesOfItsReadme) {
  const std::string command = "'" + (folder_of_course() / "course.sh").string() + "' '" +
                              testing::built_program("tactus") + "' >'" + file("log") + "' 2>&1";
  ASSERT_EQ(std::system(command.c_str()), 0) << read_file(file("log"));
  const std::string readme = read_file(kCourse / "README.md");
  const std::vector<std::string> pictures = all_of(readme, R"(!\[\]\(pictures/([^)]*)\))");
  EXPECT_EQ(all_of(readme, "\n## ([0-9]+)\\. ").size(), 12U);
  EXPECT_GE(pictures.size(), 12U);
  for (const std::string& picture : pictures) {
    EXPECT_TRUE(fs::is_regular_file(folder_of_course() / "out" / picture)) << picture;
    EXPECT_TRUE(fs::is_regular_file(kCourse / "pictures" / picture)) << picture;
  }
}

TEST_F(Course, TheFieldOfABallIsItsCollisionFormulaAndTheGodObjectGivesTheSame) {
  const nlohmann::json runs = compared(
      "01_wall/scene.toml --path 01_wall/path.csv --rates 1000 --methods "
      "potential_field,god_object");
  // F = K (r - |v|) v / |v| is largest where the tool is nearest to the middle.
  EXPECT_NEAR(runs[0]["largest_force_N"].get<double>(), 300.0 * (0.02 - 0.003), 1e-3);
  // The god-object keeps its margin of half a micrometre.
  EXPECT_LT(runs[1]["force_off_N"].get<double>(), 300.0 * 0.6e-6);
}

TEST_F(Course, AFieldLetsGoInTheMiddleOfAThinPlate) {
  const nlohmann::json runs = compared(
      "../thin_plate/scene.toml --path ../thin_plate/press.csv --methods "
      "god_object,potential_field");
  EXPECT_NEAR(runs[0]["largest_force_N"].get<double>(), 2.5, 1e-3);
  EXPECT_NEAR(runs[1]["largest_force_N"].get<double>(), 0.5 * 500.0 * 0.002, 1e-2);
  EXPECT_EQ(runs[0]["breaks"], 0);
  EXPECT_EQ(runs[1]["breaks"], 1);
}

TEST_F(Course, OnePlaneLeavesAConvexEdgeAndCrossesAConcaveOne) {
  const nlohmann::json convex = compared(
      "03_convex_edge/scene.toml --path 03_convex_edge/path.csv --rates 1000 --methods "
      "god_object,one_plane");
  EXPECT_LT(convex[0]["above_m"].get<double>(), 0.76e-6);
  EXPECT_NEAR(convex[1]["above_m"].get<double>(), 9.2e-6, 0.1e-6);
  const nlohmann::json concave = compared(
      "04_groove/scene.toml --path 04_groove/path.csv --rates 1000 --methods "
      "god_object,three_sub_goals,one_plane");
  // On the line at the bottom the tool is 3 mm below.
  EXPECT_NEAR(concave[0]["largest_force_N"].get<double>(), 3.0, 2e-3);
  EXPECT_NEAR(concave[1]["largest_force_N"].get<double>(), 3.0, 4e-3);
  EXPECT_EQ(concave[1]["below_m"].get<double>(), 0.0);
  EXPECT_GT(concave[2]["below_m"].get<double>(), 1e-6);
  EXPECT_LT(concave[2]["contact_ticks"].get<int>(), 100);
}

TEST_F(Course, OneStepATickRipplesByTheStiffnessTimesTheStep) {
  const nlohmann::json runs = compared(
      "05_three_step/scene.toml --path 05_three_step/path.csv --rates 1000 --methods "
      "god_object,three_step,one_step --from 0.4 --to 0.42");
  EXPECT_LT(runs[0]["ripple_N"].get<double>(), 1e-6);
  EXPECT_LT(runs[1]["ripple_N"].get<double>(), 1e-6);
  // K v dt, less the thousandth by which the push-out lets it follow.
  EXPECT_NEAR(runs[2]["ripple_N"].get<double>(), 1000.0 * 0.1 * 1e-3, 5e-4);
}

TEST_F(Course, APushOutOfZeroFallsThroughAndALargeOneCrossesTheOtherWall) {
  const nlohmann::json runs = compared(
      "06_push_out/scene.toml --path 06_push_out/path.csv --rates 1000 --push-outs "
      "0.001,0,0.5");
  EXPECT_GT(runs[0]["contact_ticks"].get<int>(), 600);
  EXPECT_LT(runs[1]["contact_ticks"].get<int>(), 20);
  EXPECT_NEAR(runs[2]["below_m"].get<double>(), 0.5e-3 - 0.3e-3, 1e-6);
}

TEST_F(Course, APointFallsIntoACrackAndABallDoesNot) {
  const nlohmann::json runs = compared(
      "07_crack/scene.toml --path 07_crack/path.csv --rates 1000 --methods "
      "sphere_proxy,god_object");
  EXPECT_EQ(runs[0]["breaks"], 1);
  EXPECT_NEAR(runs[0]["largest_force_N"].get<double>(), 4.0, 2e-3);
  EXPECT_EQ(runs[1]["breaks"], 2);
  EXPECT_NEAR(runs[1]["largest_force_N"].get<double>(), 5.95, 2e-3);
}

TEST_F(Course, PlainTrackingSwingsInAHollowAndBreaksInACorner) {
  const nlohmann::json hollow = compared(
      "10_implicit/scene.toml --path 10_implicit/path.csv --rates 1000 --methods "
      "tracking,plain_tracking --from 0.7");
  EXPECT_LT(hollow[0]["largest_jump_N"].get<double>(), 1e-3);
  EXPECT_GT(hollow[1]["largest_jump_N"].get<double>(), 1.0);
  // Up to a depth of the radius it comes to rest.
  const nlohmann::json shallow = compared(
      "10_implicit/scene.toml --path 10_implicit/path.csv --rates 1000 --methods "
      "tracking,plain_tracking --to 0.55");
  EXPECT_LT(shallow[1]["off_m"].get<double>(), 0.1e-3);
  const nlohmann::json corner = compared(
      "10_implicit/break.toml --path 10_implicit/break.csv --rates 1000 --methods "
      "tracking,plain_tracking");
  EXPECT_EQ(corner[0]["breaks"], 1);
  EXPECT_EQ(corner[1]["breaks"], 2);
}

TEST_F(Course, EveryFrictionModelTakesEnergy) {
  for (const nlohmann::json& run :
       compared("12_friction/scene.toml --path 12_friction/path.csv --rates 1000 --friction "
                "cone,dahl,lugre")) {
    EXPECT_LT(run["given_out_J"].get<double>(), -0.02) << run["name"];
  }
}

}  // namespace
}  // namespace tactus::host
