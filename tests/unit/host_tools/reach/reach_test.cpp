// The resolution, force and weights of a device at its handle, against closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "host_tools/bake/device/device_bake.h"
#include "host_tools/reach/reach_figure.h"
#include "host_tools/reach/reach_summary.h"
#include "host_tools/reach/scene_reach.h"
#include "tests/support/png_size.h"
#include "tests/unit/host_tools/bake/device/device_texts.h"

namespace tactus::host {
namespace {

// A Cartesian device on three ODrives, of which the vertical one carries the mass.
std::string slides_text(const std::string& mechanism_keys, const std::string& joint_keys) {
  std::string text = "[mechanism]\nkind = \"cartesian\"\n" + mechanism_keys +
                     "[controller]\nrate_hz = 500\nmax_force_N = 5\n" + kBus;
  for (int i = 0; i < 3; ++i) {
    const std::string number = std::to_string(i);
    text += odrive(number, i);
    text += joint("axis " + number, number,
                  "reference = \"known_pose\"\nmotor_ratio = 100\nencoder_ratio = 100\n"
                  "lower_m = -0.1\nupper_m = 0.1\n" +
                      joint_keys);
  }
  return text + "[plant]\nencoder_resolution_m = 2e-5\n";
}

class ReachOfADevice : public ::testing::Test {
 protected:
  ReachMap map_of(const std::string& text) {
    loaded_ = std::make_unique<LoadedDevice>(bake_device(folder_.write("device.toml", text)));
    return ReachMap(loaded_->config());
  }

  testing::TemporaryFolder folder_;
  std::unique_ptr<LoadedDevice> loaded_;
};

// Each drive gives 0.2 N m at a drum of 10 mm.
TEST_F(ReachOfADevice, SlidesGiveTheirMotorsForceLessTheWeight) {
  const ReachMap map = map_of(slides_text("carried_kg = [0.0, 1.0, 0.0]\n", "max_effort_N = 20\n"));
  const auto point = map.at({0.01, 0.02, 0.03});
  ASSERT_TRUE(point);
  EXPECT_NEAR(point->force_N, 20.0 - 9.80665, 1e-9);
  EXPECT_NEAR(point->weight_share[1], 9.80665 / 20.0, 1e-9);
  EXPECT_EQ(point->weight_share[0], 0.0);
  EXPECT_NEAR(point->resolution_m, 2e-5, 1e-12);
  EXPECT_FALSE(map.at({0.2, 0.0, 0.0}));
  EXPECT_TRUE(reach_warnings(map, summarise_reach(map)).empty());
}

TEST_F(ReachOfADevice, APaddleGivesItsTorqueOverItsLever) {
  const ReachMap map =
      map_of(paddle("", std::string(kKnownPose) + "motor_ratio = 10\nencoder_ratio = 10\n") +
             "[plant]\nencoder_resolution_rad = 0.001\n");
  constexpr double kLever_m = 0.065659;
  const ReachSummary summary = summarise_reach(map);
  // The limit of the preset is below the 2 N m of the drive.
  const double effort_Nm = 0.03 * 0.073152 / 0.004191;
  EXPECT_NEAR(summary.middle.force_N, effort_Nm / kLever_m, 1e-9);
  EXPECT_NEAR(summary.weakest_N, summary.strongest_N, 1e-9);
  EXPECT_NEAR(summary.coarsest_m, 0.001 * kLever_m, 1e-12);
  EXPECT_FALSE(map.at({0.0, -1.0, 0.0}));
}

// With the forearm hanging from a level upper arm, each joint has its own direction: no joint helps
// another, and the levers are the links.
TEST_F(ReachOfADevice, ALevelArmIsAsStrongAsItsLongestLever) {
  std::string text =
      "[mechanism]\nkind = \"phantom_premium\"\nupper_m = 0.3\nforearm_m = 0.2\n"
      "[controller]\nrate_hz = 500\nmax_force_N = 1\n" +
      std::string(kBus) + odrive("a", 0) + odrive("b", 1) + odrive("c", 2);
  for (const char* const name : {"a", "b", "c"}) {
    text += joint(
        std::string("joint ") + name, name,
        std::string(kKnownPose) + "motor_ratio = 3\nencoder_ratio = 3\nmax_effort_Nm = 0.6\n");
  }
  const ReachMap map = map_of(text + "[plant]\nencoder_resolution_rad = 0.001\n");
  const auto point = map.at({0.0, -0.2, 0.3});
  ASSERT_TRUE(point);
  EXPECT_NEAR(point->force_N, 0.6 / 0.3, 1e-9);
  EXPECT_NEAR(point->resolution_m, 0.001 * 0.3, 1e-12);
  EXPECT_FALSE(map.at({0.0, 0.0, 0.51}));
}

TEST_F(ReachOfADevice, EveryShortfallIsToldWithItsKey) {
  const auto warnings_of = [&](const std::string& text) {
    const ReachMap map = map_of(text);
    std::string all;
    for (const std::string& warning : reach_warnings(map, summarise_reach(map))) {
      all += warning + "\n";
    }
    return all;
  };
  EXPECT_TRUE(warnings_of(slides_text("", "max_effort_N = 30\n"))
                  .contains("max_effort_N 30 is more than its motor gives, 20 N"));
  EXPECT_TRUE(warnings_of(slides_text("carried_kg = [0.0, 1.5, 0.0]\n", "max_effort_N = 20\n"))
                  .contains("joint 'axis 1': the weights of [mechanism] need up to 74 %"));
  EXPECT_TRUE(warnings_of(slides_text("carried_kg = [0.0, 3.0, 0.0]\n", "max_effort_N = 20\n"))
                  .contains("the arm falls there"));
  EXPECT_TRUE(warnings_of(slides_text("", "max_effort_N = 2\n"))
                  .contains("max_force_N is 5, and the motors give at most 2 N"));
  const std::string coarse = replaced(slides_text("", "max_effort_N = 20\n"), "2e-5", "5e-4");
  EXPECT_TRUE(warnings_of(coarse).contains("moves the handle by 0.5 mm"));
}

TEST_F(ReachOfADevice, AnObjectBesideTheWorkspaceIsFoundAndItsOriginAdvised) {
  const ReachMap map = map_of(slides_text("", "max_effort_N = 20\n"));
  ObjectReach far{.name = "far", .reached_share = 0.0, .box_B = {}};
  far.box_B.include({0.2, 0.0, 0.0});
  far.box_B.include({0.3, 0.1, 0.1});
  const Vec3 origin = centred_origin(map, std::span(&far, 1));
  EXPECT_LT(
      (origin - (map.config().controller.workspace_origin_D + Vec3(-0.25, -0.05, -0.05))).norm(),
      1e-12);
  const std::string words = scene_reach_text(map, std::span(&far, 1));
  EXPECT_TRUE(words.contains("'far': the handle reaches 0 %")) << words;
  EXPECT_TRUE(words.contains("workspace_origin_m = [-0.25, -0.05, -0.05]")) << words;
}

TEST_F(ReachOfADevice, IsDrawnForEveryNumberOfJoints) {
  for (const std::string& text :
       {slides_text("", "max_effort_N = 20\n"), haply("unproven_watchdog = true\n", kKnownPose),
        paddle("", kKnownPose)}) {
    const ReachMap map = map_of(text);
    const std::filesystem::path picture = folder_.path() / "reach.png";
    draw_reach(map, {}, "a | title", "it's a subtitle", picture);
    EXPECT_EQ(testing::png_size(picture).width, 1500U);
  }
}

}  // namespace
}  // namespace tactus::host
