// `tactus inspect` and the profiles of the controller.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "rendering/profiles/microcontroller.h"
#include "tests/support/folder_test.h"
#include "tests/support/run_program.h"

namespace tactus::host {
namespace {

class InspectProfilesTest : public FolderTest {
 protected:
  // Bakes a scene of so many balls and as many tools.
  void bake_balls(std::size_t balls, std::size_t tools) const {
    std::ofstream scene(file("scene.toml"));
    scene << "[tool]\nradius_m = 0.001\ncount = " << tools << "\n";
    for (std::size_t i = 0; i < balls; ++i) {
      scene << "[[object]]\nname = \"ball" << i << "\"\nprimitive = \"sphere\"\nradius_m = 0.01\n";
    }
    scene.close();
    ASSERT_EQ(testing::run_program(folder(), "bake scene.toml").exit_code, 0);
  }
  [[nodiscard]] std::string inspect(const std::string& options = "") const {
    return testing::run_program(folder(), "inspect scene.tactus" + options).output;
  }

  static constexpr std::size_t kMost = rendering::kMicrocontrollerProfile.objects;
};

TEST_F(InspectProfilesTest, ASceneThatEveryProfileHasRoomForSaysYesThreeTimes) {
  bake_balls(kMost, 1);
  const std::string text = inspect();
  for (const std::string line :
       {"\n  desktop:         yes\n", "\n  board:           yes\n", "\n  microcontroller: yes\n"}) {
    EXPECT_NE(text.find(line), std::string::npos) << text;
  }
}

TEST_F(InspectProfilesTest, EveryCapacityThatIsExceededIsNamed) {
  bake_balls(kMost + 1, 2);
  const std::string text = inspect();
  EXPECT_NE(text.find("\n  board:           yes\n"), std::string::npos) << text;
  const std::string most = std::to_string(kMost);
  EXPECT_NE(text.find("\n  microcontroller: no, " + std::to_string(kMost + 1) + " objects, where " +
                      most + " fit; 2 tools, where 1 fits\n"),
            std::string::npos)
      << text;
}

TEST_F(InspectProfilesTest, JsonHasTheNumbers) {
  bake_balls(kMost + 1, 1);
  const auto profiles = nlohmann::json::parse(inspect(" --json")).at("profiles");
  ASSERT_EQ(profiles.size(), 3U);
  EXPECT_EQ(profiles[0].at("name"), "desktop");
  EXPECT_EQ(profiles[0].at("fits"), true);
  EXPECT_TRUE(profiles[0].at("exceeded").empty());
  EXPECT_EQ(profiles[2].at("name"), "microcontroller");
  EXPECT_EQ(profiles[2].at("fits"), false);
  const auto& exceeded = profiles[2].at("exceeded");
  ASSERT_EQ(exceeded.size(), 1U);
  EXPECT_EQ(exceeded[0].at("capacity"), "objects");
  EXPECT_EQ(exceeded[0].at("count"), kMost + 1);
  EXPECT_EQ(exceeded[0].at("limit"), kMost);
}

}  // namespace
}  // namespace tactus::host
