// Planes and sweeps of a sphere near a box and a blade, against plane geometry.
#include "rendering/contact/plane_collection.h"

#include <gtest/gtest.h>

#include <memory>

#include "rendering/contact/candidate_sweep.h"
#include "tests/support/materials.h"
#include "tests/support/solid.h"

namespace tactus::rendering {
namespace {

// A sphere near a box about the origin.
class PlaneCollectionTest : public ::testing::Test {
 protected:
  static constexpr double kRadius_m = 0.002;
  static constexpr double kHalf_m = 0.0078125;  // exact as a float

  PlaneCollectionTest() {
    EXPECT_TRUE(scene_->set({&box_.object(), 1}));
    scene_->begin_tick(0.001, 0.001);
    candidates_->begin_tick(*scene_);
    candidates_->start_tick_budget(units_of(1e6));
  }

  void put(const Vec3& p) {
    p_ = p;
    candidates_->move_to(p);
    EXPECT_EQ(candidates_->ensure(*scene_, margins_, p), CandidateSet::Gathering::complete);
  }
  PlaneCollector::Result collect() {
    return PlaneCollector(near_, p_, kMaxPushOut_m).collect(memory_, {}, planes_, flags_);
  }
  SweepResult sweep(const Vec3& goal) { return sweep_toward(near_, p_, goal, rest_, memory_); }

  testing::Solid box_{testing::box(2 * kHalf_m * Vec3::Ones()), Sides::one, testing::kSlippery};
  std::unique_ptr<SceneObjects> scene_ = std::make_unique<SceneObjects>();
  std::unique_ptr<CandidateSet> candidates_ = std::make_unique<CandidateSet>();
  ContactMargins margins_{kRadius_m};
  NearbySurfaces near_{.scene = *scene_, .margins = margins_, .candidates = *candidates_};
  ConstraintMemory memory_;
  ContactPlanes planes_;
  ProxyRest rest_;
  std::uint32_t flags_ = kTouchClean;
  Vec3 p_ = Vec3::Zero();
  // Resting on the top, near its middle, where no triangle's border is.
  const Vec3 on_top_{0.003, kHalf_m + margins_.sphere.rest_m, 0.001};
};

TEST_F(PlaneCollectionTest, AFaceGivesItsPlaneAtTheRestHeight) {
  put(on_top_ + Vec3{0.0, 0.1e-6, 0.0});
  EXPECT_EQ(collect(), PlaneCollector::Result::complete);
  ASSERT_EQ(planes_.all().size(), 1U);
  EXPECT_TRUE(planes_[0].plane.normal.isApprox(Vec3::UnitY(), 1e-12));
  EXPECT_NEAR(planes_[0].plane.offset, on_top_.y(), 1e-12);
  EXPECT_EQ(planes_[0].nearest.feature, Feature::face);
}

TEST_F(PlaneCollectionTest, NothingGivesAPlaneBeyondTheMargin) {
  put(on_top_ + Vec3{0.0, 1e-6, 0.0});
  EXPECT_EQ(collect(), PlaneCollector::Result::complete);
  EXPECT_TRUE(planes_.empty());
}

TEST_F(PlaneCollectionTest, AnEdgeGivesItsPlaneOnlyOnceItBlocks) {
  const double slant_m = margins_.sphere.rest_m / std::sqrt(2.0);
  put({kHalf_m + slant_m, kHalf_m + slant_m, 0.001});
  EXPECT_EQ(collect(), PlaneCollector::Result::complete);
  EXPECT_TRUE(planes_.empty());
  const SweepResult blocked = sweep(p_ - Vec3{0.001, 0.001, 0.0});
  ASSERT_NE(blocked.blocked_by, kNoCandidate);
  EXPECT_LT(blocked.travel_m, 1e-6);
  EXPECT_TRUE(PlaneCollector(near_, p_, 0.0).add_blocking(blocked.blocked_by, planes_, flags_));
  EXPECT_TRUE(planes_[0].plane.normal.isApprox(Vec3{1.0, 1.0, 0.0}.normalized(), 1e-9));
  EXPECT_EQ(collect(), PlaneCollector::Result::complete);  // it blocks for the rest of the tick
  EXPECT_FALSE(planes_.empty());
}

TEST_F(PlaneCollectionTest, ARecalledCandidateGivesItsPlaneFromAnyDistance) {
  put(on_top_ + Vec3{0.0, 0.1e-6, 0.0});
  collect();
  rest_.planes[0] = planes_[0];
  memory_.leave(p_, rest_, 1);
  put(on_top_ + Vec3{0.0, 5e-6, 0.0});
  collect();
  EXPECT_TRUE(planes_.empty());
  ASSERT_TRUE(memory_.recall(planes_));
  PlaneCollector(near_, p_, 0.0).add_recalled(memory_, planes_, flags_);
  ASSERT_FALSE(planes_.empty());
  EXPECT_NEAR(planes_[0].plane.offset, on_top_.y(), 1e-12);
}

TEST_F(PlaneCollectionTest, AnObjectThatTheSphereOverlapsIsLeftOut) {
  put(on_top_ - Vec3{0.0, 2 * kMaxPushOut_m, 0.0});
  EXPECT_EQ(collect(), PlaneCollector::Result::overlapped);
  EXPECT_TRUE(candidates_->left_out().has(0));
}

TEST_F(PlaneCollectionTest, AFaceALittleBelowHoldsASphereThatIsAboveIt) {
  put(on_top_ + Vec3{0.0, 5e-6, 0.0});
  PlaneCollector(near_, p_, 0.0).add_face_below(planes_, flags_);
  ASSERT_EQ(planes_.all().size(), 1U);
  EXPECT_TRUE(planes_.resting_position(p_).isApprox(on_top_, 1e-9));
}

TEST_F(PlaneCollectionTest, ASweepEndsInTheMarginOfTheFaceThatItMeets) {
  constexpr double kFall_m = 0.0005;
  put(on_top_ + Vec3{0.0, kFall_m, 0.0});
  const SweepResult result = sweep(p_ - Vec3{0.0, 2 * kFall_m, 0.0});
  EXPECT_FALSE(result.arrived);
  const double gap_m = p_.y() - result.travel_m - kHalf_m;
  EXPECT_GE(gap_m, margins_.sphere.inner_m);
  EXPECT_LE(gap_m, margins_.sphere.rest_m);
}

TEST_F(PlaneCollectionTest, ASweepAlongAFaceArrives) {
  put(on_top_);
  collect();
  rest_.planes[0] = planes_[0];
  rest_.plane_count = 1;
  const Vec3 goal = p_ + Vec3{0.0, 0.0, 0.0001};
  const SweepResult result = sweep(goal);
  EXPECT_TRUE(result.arrived);
  EXPECT_NEAR(result.travel_m, 0.0001, 1e-15);
  EXPECT_EQ(result.blocked_by, kNoCandidate);
}

TEST_F(PlaneCollectionTest, AMoveOnOneFaceNeedsNoNewPlanes) {
  put(on_top_);
  collect();
  rest_.planes[0] = planes_[0];
  rest_.plane_count = 1;
  put(on_top_ + Vec3{0.0, 0.0, 20e-6});
  EXPECT_TRUE(is_still_on_face(near_, p_, memory_, rest_));
  put({kHalf_m + 0.001, kHalf_m + kRadius_m, 0.0});  // beyond the edge
  EXPECT_FALSE(is_still_on_face(near_, p_, memory_, rest_));
}

}  // namespace
}  // namespace tactus::rendering
