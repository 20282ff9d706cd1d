#include "host_tools/simulation/wish_path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

TEST(WishPath, BetweenTwoRestsItIsTheMinimumJerkReach) {
  WishPath path({{.t_s = 1.0, .p_W = {0.0, 0.0, 0.0}}, {.t_s = 3.0, .p_W = {0.1, -0.2, 0.0}}});
  for (double s = 0.0; s <= 1.0; s += 0.01) {
    const double blend = 10.0 * std::pow(s, 3) - 15.0 * std::pow(s, 4) + 6.0 * std::pow(s, 5);
    EXPECT_LT((path.at(1.0 + 2.0 * s) - blend * Vec3(0.1, -0.2, 0.0)).norm(), 1e-15);
  }
}

TEST(WishPath, HoldsStillBeforeAndAfter) {
  WishPath path({{.t_s = 1.0, .p_W = {1.0, 2.0, 3.0}}, {.t_s = 2.0, .p_W = {4.0, 5.0, 6.0}}});
  EXPECT_EQ(path.at(0.0), Vec3(1.0, 2.0, 3.0));
  EXPECT_EQ(path.at(99.0), Vec3(4.0, 5.0, 6.0));
  EXPECT_EQ(path.end_s(), 2.0);
}

TEST(WishPath, FollowsADenselySampledLineWithoutStopping) {
  std::vector<Waypoint> waypoints;
  for (int i = 0; i <= 100; ++i) {
    waypoints.push_back({.t_s = 0.01 * i, .p_W = {0.001 * i, 0.0, 0.0}});
  }
  WishPath path(waypoints);
  for (double t = 0.02; t < 0.98; t += 0.0007) {
    EXPECT_NEAR(path.at(t).x(), 0.1 * t, 1e-14);
  }
}

TEST(WishPath, ARepeatedPathBeginsAnewAtItsEnd) {
  const WishPath path({{.t_s = 0.0, .p_W = {1.0, 0.0, 0.0}},
                       {.t_s = 1.0, .p_W = {2.0, 0.0, 0.0}},
                       {.t_s = 4.0, .p_W = {1.0, 0.0, 0.0}}});
  WishPath once = path;
  WishPath repeated = path.repeated();
  for (const double t_s : {0.0, 0.5, 1.0, 2.5, 4.0}) {
    EXPECT_EQ(repeated.at(t_s), once.at(t_s)) << t_s;
    EXPECT_EQ(repeated.at(t_s + 8.0), once.at(t_s)) << t_s;
  }
  EXPECT_EQ(repeated.end_s(), 4.0);
}

TEST(WishPath, IsSmoothThroughItsWaypoints) {
  WishPath path({{.t_s = 0.0, .p_W = {0.0, 0.0, 0.0}},
                 {.t_s = 1.0, .p_W = {0.1, 0.1, 0.0}},
                 {.t_s = 1.5, .p_W = {0.3, 0.0, 0.0}},
                 {.t_s = 3.0, .p_W = {0.4, 0.1, 0.0}}});
  const double h = 1e-5;
  for (const double t : {1.0, 1.5}) {
    const Vec3 before = (path.at(t) - path.at(t - h)) / h;
    const Vec3 after = (path.at(t + h) - path.at(t)) / h;
    EXPECT_LT((after - before).norm(), 1e-4) << "at " << t << " s";
  }
}

TEST(WishPath, NeverOvershootsATurn) {
  WishPath path({{.t_s = 0.0, .p_W = {0.0, 0.0, 0.0}},
                 {.t_s = 0.5, .p_W = {0.1, 0.0, 0.0}},
                 {.t_s = 2.0, .p_W = {0.0, 0.0, 0.0}}});
  for (double t = 0.0; t < 2.0; t += 0.001) {
    EXPECT_LE(path.at(t).x(), 0.1 + 1e-15);
    EXPECT_GE(path.at(t).x(), -1e-15);
  }
}

TEST(WishPath, RefusesTimesThatDoNotRiseAndNumbersThatAreNotFinite) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(WishPath({}), InputError);
  EXPECT_THROW(WishPath({{.t_s = 1.0}, {.t_s = 1.0}}), InputError);
  EXPECT_THROW(WishPath({{.t_s = 0.0, .p_W = {nan, 0.0, 0.0}}}), InputError);
}

}  // namespace
}  // namespace tactus::host
