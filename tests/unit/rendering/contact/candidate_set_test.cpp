#include "rendering/contact/candidate_set.h"

#include <gtest/gtest.h>

#include <memory>
#include <set>
#include <span>
#include <vector>

#include "rendering/limits.h"
#include "tests/support/brute_force.h"
#include "tests/support/materials.h"
#include "tests/support/solid.h"

namespace tactus::rendering {
namespace {

using testing::Solid;
using Gathering = CandidateSet::Gathering;

class CandidateSetTest : public ::testing::Test {
 protected:
  // A bowl little larger than the tool, which has hundreds of triangles about it wherever it rests.
  static constexpr double kToolRadius_m = 0.002;
  static constexpr double kBowlRadius_m = 0.0022;
  // The cost units of a tick, so few that a dense place takes several.
  static constexpr std::size_t kLimit = 368;

  void take(const Solid& solid) {
    ASSERT_TRUE(scene_->set({&solid.object(), 1}));
    begin_tick();
  }
  void begin_tick() {
    scene_->begin_tick(0.001 * ++ticks_, 0.001);
    candidate_set_->begin_tick(*scene_);
    candidate_set_->start_tick_budget(kLimit);
  }
  Gathering ensure(const Vec3& p) { return candidate_set_->ensure(*scene_, margins_, p); }

  std::unique_ptr<SceneObjects> scene_ = std::make_unique<SceneObjects>();
  std::unique_ptr<CandidateSet> candidate_set_ = std::make_unique<CandidateSet>();
  ContactMargins margins_{kToolRadius_m};
  // A micrometre above the bottom.
  const Vec3 place_{0.0, 0.0, -(kBowlRadius_m - kToolRadius_m) + 1e-6};
  int ticks_ = 0;
};

TEST_F(CandidateSetTest, TakesSeveralTicksForADensePlaceAndNoneTakesLong) {
  const Solid bowl(testing::icosphere(kBowlRadius_m, 5), Sides::two, testing::kSlippery);
  take(bowl);
  // A leaf more, whenever it is begun anew with a smaller capsule.
  constexpr std::size_t kOneMore = 192;
  int ticks = 1;
  while (ensure(place_) == Gathering::begun) {
    EXPECT_TRUE(candidate_set_->is_begun());
    EXPECT_LE(candidate_set_->budget().spent(), kLimit + kOneMore);
    ASSERT_LT(++ticks, 1000);
    begin_tick();
  }
  EXPECT_GT(ticks, 2);
  EXPECT_EQ(candidate_set_->gatherings(), 1U);
  std::set<std::uint32_t> found;
  for (std::size_t i = 0; i < candidate_set_->size(); ++i) {
    EXPECT_TRUE(found.insert(candidate_set_->candidate(i).index).second) << "found twice";
  }
  std::uint32_t number = 0;
  std::size_t near = 0;
  for (const testing::Corners& corners : testing::corners_of(bowl.shape())) {
    if ((testing::nearest_point(corners, place_) - place_).norm() <
        margins_.sphere.reach_m + 1e-6) {
      EXPECT_TRUE(found.contains(number)) << "triangle " << number << " is near";
      ++near;
    }
    ++number;
  }
  EXPECT_GT(near, 10U);
  begin_tick();
  EXPECT_EQ(ensure(place_), Gathering::complete);
  EXPECT_EQ(candidate_set_->budget().spent(), 0U);
}

TEST_F(CandidateSetTest, BeginsAnewWhereTheProxyDidNotWait) {
  const Solid bowl(testing::icosphere(kBowlRadius_m, 5), Sides::two, testing::kSlippery);
  take(bowl);
  ASSERT_EQ(ensure(place_), Gathering::begun);
  begin_tick();
  ensure(Vec3::Zero());
  EXPECT_EQ(candidate_set_->gatherings(), 2U);
}

TEST_F(CandidateSetTest, DoesNotWaitWhereAnObjectMoves) {
  const Solid bowl(testing::icosphere(kBowlRadius_m, 5), Sides::two, testing::kSlippery);
  Object moving = bowl.object();
  moving.moves = true;
  ASSERT_TRUE(scene_->set({&moving, 1}));
  begin_tick();
  ASSERT_EQ(ensure(place_), Gathering::begun);
  for (int tick = 0; tick < 20; ++tick) {
    RigidPose X_WO;
    X_WO.translation = {0.0, 0.0, 1e-9 * (tick + 1)};
    ASSERT_TRUE(scene_->set_pose(0, X_WO, {}));
    begin_tick();
    ASSERT_NE(ensure(place_), Gathering::begun) << "tick " << tick;
    ASSERT_GT(candidate_set_->size(), 10U);
  }
}

TEST_F(CandidateSetTest, AtTheEndOfASegmentFindsWhatItWouldFindAnew) {
  const Solid bowl(testing::icosphere(0.1, 5), Sides::two, testing::kSlippery);
  take(bowl);
  Vec3 p{0.0, 0.0, -0.1 + kToolRadius_m + 1e-6};
  std::size_t found = 0;
  for (int i = 0; i < 200; ++i) {
    ASSERT_EQ(ensure(p), Gathering::complete);
    candidate_set_->move_to(p);
    for (const std::uint16_t k : candidate_set_->within_reach_here()) {
      candidate_set_->nearest(k, *scene_);
    }
    const Vec3 end = p + Vec3{4e-6 * (i % 7), 3e-6 * (i % 5), 1e-7 * (i % 3)};
    for (const std::uint16_t k : candidate_set_->within_reach(end)) {
      candidate_set_->nearest(k, *scene_);
    }
    candidate_set_->move_to_end(end);
    const std::span<const std::uint16_t> first = candidate_set_->within_reach_here();
    const std::vector<std::uint16_t> there(first.begin(), first.end());
    candidate_set_->move_to(end);
    const std::span<const std::uint16_t> anew = candidate_set_->within_reach_here();
    ASSERT_EQ(there, std::vector<std::uint16_t>(anew.begin(), anew.end())) << "way " << i;
    found += there.size();
    p = end;
    begin_tick();
  }
  EXPECT_GT(found, 200U);
}

// A sphere of 0.1 m, and the tool on its top, from where a tick's move of a millimetre leaves the
// trusted capsule.
class LookAheadTest : public CandidateSetTest {
 protected:
  void SetUp() override {
    take(ball_);
    ASSERT_EQ(ensure(top_), Gathering::complete);
    ASSERT_FALSE(candidate_set_->trusts(next_));
    begin_tick();
  }
  void look_ahead(const Vec3& next) { candidate_set_->look_ahead(*scene_, margins_, top_, next); }

  const Solid ball_{testing::icosphere(0.1, 5), Sides::one, testing::kSlippery};
  const Vec3 top_{0.0, 0.0, 0.1 + kToolRadius_m + 1e-6};
  const Vec3 next_ = top_ + Vec3{1e-3, 0.0, 0.0};
};

TEST_F(LookAheadTest, TheNextTickNeedNotGather) {
  look_ahead(next_);
  EXPECT_EQ(candidate_set_->gatherings(), 2U);
  begin_tick();
  EXPECT_EQ(ensure(top_), Gathering::complete);
  EXPECT_EQ(candidate_set_->gatherings(), 2U);
  EXPECT_EQ(candidate_set_->budget().spent(), 0U);
}

TEST_F(LookAheadTest, DoesNothingWhereTheNextMoveIsTrusted) {
  look_ahead(top_ + Vec3{1e-6, 0.0, 0.0});
  EXPECT_EQ(candidate_set_->budget().spent(), 0U);
}

TEST_F(LookAheadTest, DoesNothingAfterMuchWork) {
  candidate_set_->budget().spend(kLimit);
  look_ahead(next_);
  EXPECT_EQ(candidate_set_->gatherings(), 1U);
}

TEST_F(LookAheadTest, DoesNothingForAPoint) {
  margins_ = ContactMargins{0.0};
  look_ahead(next_);
  EXPECT_EQ(candidate_set_->gatherings(), 1U);
}

TEST_F(LookAheadTest, DoesNothingWhereAnObjectMoved) {
  Object moving = ball_.object();
  moving.moves = true;
  ASSERT_TRUE(scene_->set({&moving, 1}));
  candidate_set_->clear();
  begin_tick();
  ASSERT_EQ(ensure(top_), Gathering::complete);
  RigidPose X_WO;
  X_WO.translation = {0.0, 0.0, 1e-9};
  ASSERT_TRUE(scene_->set_pose(0, X_WO, {}));
  begin_tick();
  ASSERT_EQ(ensure(top_), Gathering::complete);
  const std::size_t gatherings = candidate_set_->gatherings();
  look_ahead(next_);
  EXPECT_EQ(candidate_set_->gatherings(), gatherings);
}

}  // namespace
}  // namespace tactus::rendering
