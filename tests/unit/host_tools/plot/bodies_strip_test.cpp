// The strip of the moving world, as a user draws it with the program.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "host_tools/files/atomic_file.h"
#include "host_tools/input_error.h"
#include "host_tools/plot/bodies_data.h"
#include "tests/support/folder_test.h"
#include "tests/support/paths.h"
#include "tests/support/run_program.h"
#include "tests/support/xml_check.h"

namespace tactus::host {
namespace {

class BodiesStripTest : public FolderTest {
 protected:
  void SetUp() override {
    const std::string grasp = testing::in_repository("host_tools/examples/grasp");
    run("bake '" + grasp + "/scene.toml' -o grasp.tactus");
    run(
        fmt::format("touch grasp.tactus --path '{0}/thumb.csv' --path '{0}/finger.csv' --rate 100 "
                    "-o run.csv --bodies bodies.csv",
                    grasp));
  }

  // Runs the program, and returns what it printed.
  std::string run(const std::string& arguments, int exit_code = 0) {
    const testing::Outcome outcome = testing::run_program(folder(), arguments);
    EXPECT_EQ(outcome.exit_code, exit_code) << arguments << "\n" << outcome.output;
    return outcome.output;
  }
};

TEST_F(BodiesStripTest, HasBodiesAndToolsAtEqualDistancesOfTime) {
  run("plot run.csv --bodies bodies.csv --frames 3 --scene grasp.tactus -o strip.svg");
  const std::string text = read_file(file("strip.svg"));
  EXPECT_EQ(testing::xml_fault(text), "");
  const std::vector<BodiesFrame> frames = read_bodies(file("bodies.csv"), 1);
  for (const double t_s : {0.0, frames[(frames.size() - 1) / 2].t_s, frames.back().t_s}) {
    EXPECT_NE(text.find(fmt::format("{:.2f} s<", t_s)), std::string::npos) << t_s;
  }
  // The bodies alone, in a folder and in the default format.
  EXPECT_EQ(run("plot bodies.csv --frames 2 --scene grasp.tactus"), "./bodies_frames.png\n");
}

TEST_F(BodiesStripTest, SaysWhatIsMissing) {
  EXPECT_NE(run("plot run.csv --frames 3 --scene grasp.tactus", 2).find("--bodies bodies.csv"),
            std::string::npos);
  for (const char* const number : {"1", "13", "x", "3x"}) {
    EXPECT_NE(run(fmt::format("plot bodies.csv --frames {} --scene grasp.tactus", number), 2)
                  .find("2 to 12"),
              std::string::npos);
  }
  const std::string stack = testing::in_repository("host_tools/examples/stack");
  run("bake '" + stack + "/scene.toml' -o stack.tactus");
  EXPECT_NE(run("plot bodies.csv --frames 3 --scene stack.tactus", 2).find("5 bodies"),
            std::string::npos);
}

TEST_F(BodiesStripTest, ReadsPlacesAndRefusesRowsOfAnotherScene) {
  write_file_atomically(file("two.csv"), std::as_bytes(std::span(std::string_view(
                                             "t_s,body,x_m,y_m,z_m,qw,qx,qy,qz\n0,a,1,2,3,1,0,0,0\n"
                                             "0,b,4,5,6,0.5,0.5,0.5,0.5\n0.1,a,1,2,3,1,0,0,0\n"
                                             "0.1,b,4,5,6,1,0,0,0\n"))));
  const std::vector<BodiesFrame> frames = read_bodies(file("two.csv"), 2);
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_EQ(frames[0].bodies[1].center_W, Vec3(4.0, 5.0, 6.0));
  // A third of a turn about (1, 1, 1) takes x to y.
  EXPECT_LT((frames[0].bodies[1].axes_W.col(0) - Vec3::UnitY()).norm(), 1e-12);
  EXPECT_THROW(read_bodies(file("two.csv"), 3), InputError);
  EXPECT_THROW(read_bodies(file("two.csv"), 4), InputError);
}

}  // namespace
}  // namespace tactus::host
