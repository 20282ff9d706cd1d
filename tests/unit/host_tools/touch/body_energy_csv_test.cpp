// The file of `tactus touch --body-energy`: two fingers lift a cube of 0.1 kg by 70 mm, tilt it and
// let it fall.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <span>
#include <string>
#include <string_view>

#include "host_tools/csv/csv_table.h"
#include "tests/support/folder_test.h"
#include "tests/support/paths.h"
#include "tests/support/run_program.h"

namespace tactus::host {
namespace {

constexpr std::array<std::string_view, 5> kEnergyColumns{"t_s", "kinetic_J", "potential_J",
                                                         "work_by_hands_J", "lost_J"};
constexpr double kWeight_N = 0.1 * 9.80665;
constexpr double kLift_m = 0.07;

class BodyEnergyCsvTest : public FolderTest {
 protected:
  std::string run(const std::string& arguments, int exit_code = 0) {
    const testing::Outcome outcome = testing::run_program(folder(), arguments);
    EXPECT_EQ(outcome.exit_code, exit_code) << arguments << "\n" << outcome.output;
    return outcome.output;
  }
  CsvTable energy_of_a_grasp() {
    const std::string grasp = testing::in_repository("host_tools/examples/grasp");
    run("bake '" + grasp + "/scene.toml' -o grasp.tactus");
    run(
        fmt::format("touch grasp.tactus --path '{0}/thumb.csv' --path '{0}/finger.csv' --rate 1000 "
                    "-o run.csv --body-energy energy.csv",
                    grasp));
    return CsvTable::read(file("energy.csv"), kEnergyColumns);
  }
};

std::size_t tick_at(double t_s) {
  return static_cast<std::size_t>(std::lround(1e3 * t_s));
}

// Little is lost in the lift: the fingers hold the cube, and the ground only lets it go.
TEST_F(BodyEnergyCsvTest, TheHandsGiveABodyWhatItGainsInALift) {
  const CsvTable energy = energy_of_a_grasp();
  const std::size_t up = tick_at(1.4);
  const double gain_J = kWeight_N * kLift_m;
  EXPECT_NEAR(energy.column("potential_J")[up] - energy.column("potential_J")[0], gain_J,
              0.02 * gain_J);
  EXPECT_NEAR(energy.column("work_by_hands_J")[up], gain_J, 0.02 * gain_J);
  EXPECT_NEAR(energy.column("lost_J")[up], 0.0, 0.01 * gain_J);
}

// The fall lasts from 3.02 s to 3.11 s at least. Afterwards the ground has taken all.
TEST_F(BodyEnergyCsvTest, AFallKeepsTheEnergyAndTheGroundTakesIt) {
  const CsvTable energy = energy_of_a_grasp();
  const auto kinetic = energy.column("kinetic_J");
  const auto lost = energy.column("lost_J");
  const auto work = energy.column("work_by_hands_J");
  const std::size_t begin = tick_at(3.03);
  const std::size_t end = tick_at(3.1);
  EXPECT_GT(kinetic[end] - kinetic[begin], 0.2 * kWeight_N * kLift_m);
  for (std::size_t i = begin; i < end; ++i) {
    EXPECT_NEAR(lost[i], lost[begin], 0.5 * kWeight_N * 2.5e-4 * 1.2) << i;
    EXPECT_EQ(work[i], work[begin]) << i;
  }
  EXPECT_NEAR(kinetic.back(), 0.0, 1e-9);
  EXPECT_NEAR(lost.back(), work.back(), 1e-4) << "it lies where it lay";
}

TEST_F(BodyEnergyCsvTest, ASceneWithoutBodiesIsRefused) {
  const std::string stone = testing::in_repository("host_tools/examples/stone/scene.toml");
  run("bake '" + stone + "' -o stone.tactus");
  EXPECT_NE(run("touch stone.tactus --path '" +
                    testing::in_repository("host_tools/examples/grasp/thumb.csv") +
                    "' -o run.csv --body-energy energy.csv",
                2)
                .find("leave out --body-energy"),
            std::string::npos);
}

}  // namespace
}  // namespace tactus::host
