// `tactus demo` as a user runs it on a machine that has nothing but the program and gnuplot.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>

#include "host_tools/csv/csv_table.h"
#include "host_tools/files/atomic_file.h"
#include "tests/support/folder_test.h"
#include "tests/support/paths.h"
#include "tests/support/png_size.h"
#include "tests/support/run_program.h"

namespace tactus::host {
namespace {

using testing::in_repository;
using testing::Outcome;
using testing::png_size;
using testing::run_program;

class DemoProgram : public FolderTest {
 protected:
  [[nodiscard]] Outcome run(const std::string& arguments) const {
    return run_program(folder(), arguments);
  }
};

// A point within the line that the hand draws, x and y, m.
const Eigen::Vector2d kMiddleOfTheHeart_m(-0.05, 0.003);

// Returns how far a point is from the heart of the example, m, to first order: f / |grad f|.
double distance_from_heart_m(double x_m, double y_m, double z_m) {
  constexpr double kScale_m = 0.03;
  const auto f = [](double x, double y, double z) {
    const double a = x * x + 2.25 * y * y + z * z - 1.0;
    return a * a * a - x * x * z * z * z - 0.1125 * y * y * z * z * z;
  };
  const double x = (x_m + 0.05) / kScale_m;
  const double y = -z_m / kScale_m;
  const double z = y_m / kScale_m;
  constexpr double kStep = 1e-5;
  const double slope =
      std::hypot(f(x + kStep, y, z) - f(x - kStep, y, z), f(x, y + kStep, z) - f(x, y - kStep, z),
                 f(x, y, z + kStep) - f(x, y, z - kStep)) /
      (2.0 * kStep);
  return f(x, y, z) / slope * kScale_m;
}

TEST_F(DemoProgram, DrawsAHeartOnTheHeartInAnEmptyFolder) {
  const Outcome outcome = run("demo");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  for (const std::string name : {"run_path.png", "run_force.png"}) {
    EXPECT_GT(png_size(file("tactus-demo/" + name)).width, 1000U) << name;
    EXPECT_GT(png_size(file("tactus-demo/" + name)).height, 500U) << name;
    EXPECT_NE(outcome.output.find("  tactus-demo/" + name + "  "), std::string::npos)
        << outcome.output;
  }
  EXPECT_NE(outcome.output.find("faults      none"), std::string::npos) << outcome.output;

  const std::array<std::string_view, 4> columns = {"proxy_x_m", "proxy_y_m", "proxy_z_m",
                                                   "contact"};
  const CsvTable rows = CsvTable::read(file("tactus-demo/run.csv"), columns);
  EXPECT_EQ(rows.rows(), 10000U) << "ten seconds";
  const auto x_m = rows.column("proxy_x_m");
  const auto y_m = rows.column("proxy_y_m");
  const auto z_m = rows.column("proxy_z_m");
  double turned = 0.0;
  std::optional<double> before;
  for (std::size_t i = 0; i < rows.rows(); ++i) {
    if (rows.column("contact")[i] == 0.0) {
      continue;
    }
    EXPECT_NEAR(distance_from_heart_m(x_m[i], y_m[i], z_m[i]), 0.0, 2e-6) << "tick " << i;
    const double angle =
        std::atan2(y_m[i] - kMiddleOfTheHeart_m.y(), x_m[i] - kMiddleOfTheHeart_m.x());
    turned += std::remainder(angle - before.value_or(angle), 2.0 * std::numbers::pi);
    before = angle;
  }
  EXPECT_NEAR(std::abs(turned), 2.0 * std::numbers::pi, 0.2) << "once about the middle";
}

TEST_F(DemoProgram, DoesWhatBakeSimAndPlotDo) {
  ASSERT_EQ(run("demo").exit_code, 0);
  const std::string heart = in_repository("host_tools/examples/heart/");
  ASSERT_EQ(run("bake " + heart + "scene.toml -o scene.tactus").exit_code, 0);
  ASSERT_EQ(run("sim scene.tactus --path " + heart + "wish.csv -o run.csv").exit_code, 0);
  ASSERT_EQ(run("plot run.csv --scene scene.tactus").exit_code, 0);
  for (const std::string name : {"scene.tactus", "run.csv", "run_force.png", "run_path.png"}) {
    EXPECT_EQ(read_file(file("tactus-demo/" + name)), read_file(file(name))) << name;
  }
}

TEST_F(DemoProgram, StrokesTheFrontOfAnotherSceneAndKeepsIt) {
  const std::string scene =
      "[[object]]\nname = \"ball\"\nprimitive = \"sphere\"\nradius_m = 0.03\n"
      "stiffness_N_per_m = 500.0\n";
  std::filesystem::create_directory(file("ball"));
  std::ofstream(file("ball/scene.toml")) << scene;
  const Outcome outcome = run("demo ball");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_EQ(read_file(file("ball/scene.toml")), scene);
  EXPECT_FALSE(std::filesystem::exists(file("ball/wish.csv")));
  EXPECT_EQ(outcome.output.find("contact     none"), std::string::npos) << outcome.output;
}

TEST_F(DemoProgram, WritesNothingIntoAFolderOfOtherThings) {
  std::filesystem::create_directory(file("thesis"));
  std::ofstream(file("thesis/chapter1.tex")) << "text";
  const Outcome outcome = run("demo thesis");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.output.find("tactus demo: thesis: has no scene.toml; name "), std::string::npos)
      << outcome.output;
  const std::filesystem::directory_iterator entries(file("thesis"));
  EXPECT_EQ(std::distance(begin(entries), end(entries)), 1);
}

TEST_F(DemoProgram, SaysWhichPackageDrawsAndKeepsTheRun) {
  const std::string path = std::getenv("PATH");
  ASSERT_EQ(::setenv("PATH", folder(), 1), 0);
  const Outcome outcome = run("demo");
  ASSERT_EQ(::setenv("PATH", path.c_str(), 1), 0);
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.output.find("gnuplot-nox"), std::string::npos) << outcome.output;
  EXPECT_TRUE(std::filesystem::exists(file("tactus-demo/run.csv")));
}

}  // namespace
}  // namespace tactus::host
