// The example of a cup with a ball in it, as a user runs it with the program.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "host_tools/plot/bodies_data.h"
#include "tests/support/folder_test.h"
#include "tests/support/paths.h"
#include "tests/support/run_program.h"

namespace tactus::host {
namespace {

class CupExampleTest : public FolderTest {
 protected:
  void SetUp() override { run("bake '" + cup_ + "/scene.toml' -o cup.tactus"); }

  std::string run(const std::string& arguments) {
    const testing::Outcome outcome = testing::run_program(folder(), arguments);
    EXPECT_EQ(outcome.exit_code, 0) << arguments << "\n" << outcome.output;
    return outcome.output;
  }

  const std::string cup_ = testing::in_repository("host_tools/examples/cup");
};

// The ball is the first body and the cup the second. The cup is tilted by 30 degrees while it is
// carried.
TEST_F(CupExampleTest, TheBallStaysInTheCupThatIsCarriedTiltedAndSetDown) {
  constexpr double kInnerRadius_m = 0.026;
  constexpr double kBall_m = 0.019;
  run(
      fmt::format("touch cup.tactus --path '{0}/thumb.csv' --path '{0}/finger.csv' --rate 1000 "
                  "-o run.csv --bodies bodies.csv",
                  cup_));
  const std::vector<BodiesFrame> frames = read_bodies(file("bodies.csv"), 2);
  double most_upright = 1.0;
  for (const BodiesFrame& frame : frames) {
    const BodyPlace& cup = frame.bodies[1];
    const Vec3 ball = cup.axes_W.transpose() * (frame.bodies[0].center_W - cup.center_W);
    ASSERT_LT(std::hypot(ball.x(), ball.z()), kInnerRadius_m / std::cos(0.27) - kBall_m)
        << frame.t_s << ": within the corners of the walls";
    most_upright = std::min(most_upright, cup.axes_W(1, 1));
  }
  EXPECT_NEAR(most_upright, std::cos(std::numbers::pi / 6.0), 0.02);
  const BodyPlace& ball = frames.back().bodies[0];
  const BodyPlace& cup = frames.back().bodies[1];
  EXPECT_NEAR(cup.center_W.x(), 0.11, 1e-3) << "it was carried";
  EXPECT_NEAR(cup.axes_W(1, 1), 1.0, 1e-6) << "and stands";
  EXPECT_NEAR(ball.center_W.y(), 0.023, 1e-4) << "with the ball on its floor";
}

TEST_F(CupExampleTest, InspectListsTheParts) {
  const std::string text = run("inspect cup.tactus");
  EXPECT_NE(text.find("  part 1     cylinder, (-0.029, 0, -0.029) to (0.029, 0.004, 0.029) m\n"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("  part 13    box, "), std::string::npos) << text;
  EXPECT_EQ(text.find("  part 14"), std::string::npos) << text;
  EXPECT_NE(run("inspect cup.tactus --json").find("\"body_parts\":[{\"kind\":\"cylinder\""),
            std::string::npos);
}

}  // namespace
}  // namespace tactus::host
