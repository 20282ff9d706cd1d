#include "rendering/contact/contact_planes.h"

#include <gtest/gtest.h>

#include "tests/unit/rendering/contact/steps/add_plane.h"

namespace tactus::rendering {
namespace {

ContactPlane plane(const Vec3& normal, double offset_m, double distance_m = 0.0) {
  ContactPlane contact{.plane = {.normal = normal, .offset = offset_m}};
  contact.nearest.distance = distance_m;
  return contact;
}

class ContactPlanesTest : public ::testing::Test {
 protected:
  bool add(const ContactPlane& contact) { return testing::add_plane(planes_, contact, flags_); }

  ContactPlanes planes_;
  std::uint32_t flags_ = kTouchClean;
};

TEST_F(ContactPlanesTest, AreAddedOnceWhenTwoTrianglesShareAnEdge) {
  EXPECT_TRUE(add(plane(Vec3::UnitY(), 0.001)));
  EXPECT_FALSE(add(plane(Vec3::UnitY(), 0.001)));
  EXPECT_FALSE(add(plane(Vec3::UnitY(), 0.0005)));  // bounds less
  EXPECT_TRUE(add(plane(Vec3::UnitY(), 0.002)));    // bounds more
  EXPECT_TRUE(add(plane(Vec3::UnitX(), 0.001)));
  EXPECT_EQ(planes_.all().size(), 3U);
}

TEST_F(ContactPlanesTest, BeyondTheirNumberTheNearestSurfacesAreKept) {
  for (std::size_t i = 0; i < kMaxContactPlanes + 3; ++i) {
    const double angle = 0.01 * static_cast<double>(i);
    const double distance_m = 0.002 - 1e-9 * static_cast<double>(i);
    EXPECT_EQ(flags_, i <= kMaxContactPlanes ? kTouchClean : kTouchPlanesOverflow) << i;
    EXPECT_TRUE(add(plane({std::sin(angle), std::cos(angle), 0.0}, 0.0, distance_m)));
  }
  EXPECT_FALSE(add(plane(Vec3::UnitZ(), 0.0, 0.003)));
  ASSERT_EQ(planes_.all().size(), kMaxContactPlanes);
  for (const ContactPlane& kept : planes_.all()) {
    EXPECT_LT(kept.nearest.distance, 0.002 - 2.5e-9);
  }
}

TEST_F(ContactPlanesTest, ProjectTheToolOnTheirCorner) {
  add(plane(Vec3::UnitX(), 0.001));
  add(plane(Vec3::UnitY(), 0.002));
  add(plane(Vec3::UnitZ(), -0.003));
  const Vec3 h{-0.004, -0.001, 0.007};
  const PlaneProjection projection = planes_.project({0.001, 0.002, 0.007}, h);
  EXPECT_TRUE(projection.feasible);
  EXPECT_TRUE(projection.point.isApprox(Vec3{0.001, 0.002, 0.007}, 1e-12));
  ASSERT_EQ(projection.active_count, 2U);  // the third does not push
  EXPECT_NEAR(projection.pressure_m[0] + projection.pressure_m[1], 0.005 + 0.003, 1e-12);
}

TEST_F(ContactPlanesTest, LeaveTheProxyWhereItIsWhenTheyPushAgainstEachOther) {
  add(plane(Vec3::UnitX(), 0.001));
  add(plane(-Vec3::UnitX(), 0.001));  // x <= -1 mm
  const Vec3 p = Vec3::Zero();
  const Vec3 h{0.0, -0.004, 0.0};
  const PlaneProjection projection = planes_.project(p, h);
  EXPECT_LE((projection.point - h).norm(), (p - h).norm() + 1e-12);
  EXPECT_NEAR(projection.point.x(), 0.0, 1e-9);  // it slides between them, and is not pushed
}

TEST_F(ContactPlanesTest, LiftALowProxyToItsRestHeightAndNoFarther) {
  constexpr double kLow_m = 0.1e-6;
  add(plane(Vec3::UnitY(), kLow_m));
  EXPECT_TRUE(planes_.resting_position(Vec3::Zero()).isApprox(Vec3{0.0, kLow_m, 0.0}, 1e-12));
  const Vec3 above{0.003, 2 * kLow_m, 0.0};
  EXPECT_EQ(planes_.resting_position(above), above);
  planes_.set_above_first(true);
  EXPECT_TRUE(planes_.resting_position(above).isApprox(Vec3{0.003, kLow_m, 0.0}, 1e-12));
  planes_.clear();
  add(plane(Vec3::UnitY(), 2 * kMaxPushOut_m));
  EXPECT_EQ(planes_.resting_position(Vec3::Zero()), Vec3::Zero());  // too far for one tick
}

TEST_F(ContactPlanesTest, KnowTheirCandidatesAndThePointsThatTheyAllow) {
  ContactPlane contact = plane(Vec3::UnitY(), 0.001);
  contact.candidate = 7;
  add(contact);
  EXPECT_TRUE(planes_.has(7));
  EXPECT_FALSE(planes_.has(0));
  EXPECT_TRUE(planes_.allow({5.0, 0.001, -3.0}));
  EXPECT_FALSE(planes_.allow({0.0, 0.000999, 0.0}));
}

}  // namespace
}  // namespace tactus::rendering
