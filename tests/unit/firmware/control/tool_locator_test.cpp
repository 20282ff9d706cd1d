#include "firmware/control/tool_locator.h"

#include <gtest/gtest.h>

#include <limits>

#include "firmware/safety/faults.h"

namespace tactus::firmware {
namespace {

ToolLocator locator_of(ControllerConfig config) {
  config.workspace_origin_D = {0.01, 0.02, 0.03};
  ToolLocator locator;
  locator.configure(config);
  return locator;
}

TEST(ToolLocator, PutsTheToolIntoTheWorldFrame) {
  ToolLocator locator = locator_of(cartesian_config());
  const Location found =
      locator.locate({.position = {0.05, 0.05, 0.05}, .velocity = {0.1, 0.2, 0.3}});
  EXPECT_TRUE(found.is_finite);
  EXPECT_EQ(found.faults, kNoFault);
  EXPECT_LT((locator.tool.p_W - Vec3(0.04, 0.03, 0.02)).norm(), 1e-15);
  EXPECT_LT((locator.tool.v_W - Vec3(0.1, 0.2, 0.3)).norm(), 1e-15);
}

TEST(ToolLocator, AToolThatIsNoNumberStaysWhereItWasAtRest) {
  ToolLocator locator = locator_of(cartesian_config());
  locator.locate({.position = {0.05, 0.05, 0.05}, .velocity = {0.1, 0.2, 0.3}});
  const double huge = std::numeric_limits<double>::max();
  const double endless = std::numeric_limits<double>::infinity();
  for (const double speed : {endless, -endless}) {
    const Location lost = locator.locate({.position = {huge, 0.0, 0.0}, .velocity = {speed}});
    EXPECT_FALSE(lost.is_finite);
    EXPECT_EQ(lost.faults, kFaultToolNotFinite);
    EXPECT_LT((locator.tool.p_W - Vec3(0.04, 0.03, 0.02)).norm(), 1e-15);
    EXPECT_EQ(locator.tool.v_W, Vec3::Zero());
  }
  EXPECT_TRUE(locator.locate({.position = {0.05, 0.05, 0.05}}).is_finite) << "the filter is clear";
}

TEST(ToolLocator, SaysWhyAMechanismHasNoPose) {
  ToolLocator locator = locator_of(falcon_config());
  const Location found = locator.locate({.position = {3.0, 3.0, 3.0}});
  EXPECT_EQ(found.faults & ~(kFaultKinematicsNotConverged | kFaultKinematicsSingular), kNoFault);
  EXPECT_NE(found.faults, kNoFault);
}

}  // namespace
}  // namespace tactus::firmware
