#include "rendering/contact/constraint_memory.h"

#include <gtest/gtest.h>

#include "tests/unit/rendering/contact/steps/add_plane.h"

namespace tactus::rendering {
namespace {

// A proxy that was held by the candidates 4 and 9 at the origin, and has moved to x = 1 mm.
class ConstraintMemoryTest : public ::testing::Test {
 protected:
  ConstraintMemoryTest() {
    ProxyRest rest;
    rest.planes[0].candidate = 4;
    rest.planes[1].candidate = 9;
    memory_.leave(Vec3::Zero(), rest, 2);
  }

  ConstraintMemory memory_;
  const Vec3 p_{0.001, 0.0, 0.0};
};

TEST_F(ConstraintMemoryTest, SeesACycleInAMoveThatReturnsOrEndsNoNearerToTheTool) {
  const Vec3 tool{0.002, -0.001, 0.0};
  EXPECT_TRUE(memory_.would_cycle(p_, {0.0001, 0.0, 0.0}, tool));   // back to where it was
  EXPECT_TRUE(memory_.would_cycle(p_, {0.004, 0.001, 0.0}, tool));  // farther from the tool
  EXPECT_FALSE(memory_.would_cycle(p_, {0.002, 0.0, 0.0}, tool));
  memory_.clear();
  EXPECT_FALSE(memory_.would_cycle(p_, Vec3::Zero(), tool));
}

TEST_F(ConstraintMemoryTest, RecallsOnceTheCandidatesThatGiveNoPlaneNow) {
  ContactPlanes planes;
  std::uint32_t flags = kTouchClean;
  ContactPlane there{.plane = {.normal = Vec3::UnitY(), .offset = 0.0}};
  there.candidate = 4;
  testing::add_plane(planes, there, flags);
  EXPECT_TRUE(memory_.recall(planes));
  ASSERT_EQ(memory_.recalled().size(), 1U);
  EXPECT_EQ(memory_.recalled()[0], 9U);
  EXPECT_FALSE(memory_.recall(planes));
}

TEST_F(ConstraintMemoryTest, ForgetsWhatBlockedWhenTheNumbersChange) {
  EXPECT_FALSE(memory_.is_blocking(3));
  memory_.add_blocking(3);
  memory_.add_blocking(3);
  EXPECT_TRUE(memory_.is_blocking(3));
  for (std::size_t i = 0; i < 2 * kMaxContactPlanes; ++i) {
    memory_.add_blocking(100 + i);  // more than it has room for
  }
  EXPECT_TRUE(memory_.is_blocking(3));
  memory_.clear();
  EXPECT_FALSE(memory_.is_blocking(3));
}

}  // namespace
}  // namespace tactus::rendering
