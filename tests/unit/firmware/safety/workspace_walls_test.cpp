#include "firmware/safety/workspace_walls.h"

#include <gtest/gtest.h>

#include "firmware/safety/faults.h"

namespace tactus::firmware {
namespace {

class WorkspaceWallsTest : public ::testing::Test {
 protected:
  WorkspaceWallsTest() {
    ControllerConfig config;
    config.safety.workspace_lower_W = {-0.1, -0.2, -0.3};
    config.safety.workspace_upper_W = {0.1, 0.2, 0.3};
    walls_.configure(config);  // 500 N/m, 1 N s/m, 20 mm
  }
  WorkspaceWalls walls_;
};

TEST_F(WorkspaceWallsTest, InsideThereIsNothing) {
  EXPECT_EQ(walls_.check({0.0999, -0.1999, 0.2999}), kNoFault);
  EXPECT_EQ(walls_.push_W({.p_W = {0.0999, -0.1999, 0.2999}, .v_W = {9.0, 9.0, 9.0}}),
            Vec3::Zero());
}

TEST_F(WorkspaceWallsTest, AWallPushesBackAndThenIsAFault) {
  EXPECT_EQ(walls_.check({0.119, 0.0, 0.0}), kLimitWorkspace);
  EXPECT_EQ(walls_.check({0.0, 0.0, -0.321}), kLimitWorkspace | kFaultWorkspace);
  EXPECT_TRUE(walls_.push_W({.p_W = {0.11, -0.21, 0.0}}).isApprox(Vec3(-5.0, 5.0, 0.0), 1e-9));
}

TEST_F(WorkspaceWallsTest, AWallDampsAndNeverPulls) {
  EXPECT_NEAR(walls_.push_W({.p_W = {0.11, 0.0, 0.0}, .v_W = {2.0, 0.0, 0.0}}).x(), -7.0, 1e-9);
  EXPECT_EQ(walls_.push_W({.p_W = {0.11, 0.0, 0.0}, .v_W = {-9.0, 0.0, 0.0}}).x(), 0.0);
  EXPECT_NEAR(walls_.push_W({.p_W = {0.0, -0.21, 0.0}, .v_W = {0.0, -2.0, 0.0}}).y(), 7.0, 1e-9);
  EXPECT_EQ(walls_.push_W({.p_W = {0.0, -0.21, 0.0}, .v_W = {0.0, 9.0, 0.0}}).y(), 0.0);
}

}  // namespace
}  // namespace tactus::firmware
