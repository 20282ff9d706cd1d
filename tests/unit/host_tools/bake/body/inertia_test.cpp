#include "host_tools/bake/body/inertia.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <limits>
#include <random>
#include <vector>

#include "tests/unit/host_tools/bake/temporary_folder.h"

namespace tactus::host {
namespace {

using testing::contains;
using testing::input_error;

std::string inertia_error(const std::vector<double>& numbers) {
  return input_error([&] { inertia_of_numbers(numbers); });
}

std::vector<double> row_by_row(const Mat3& m) {
  return {m(0, 0), m(0, 1), m(0, 2), m(1, 0), m(1, 1), m(1, 2), m(2, 0), m(2, 1), m(2, 2)};
}

TEST(Inertia, IsReadFromMomentsAndFromTheMatrix) {
  EXPECT_EQ(inertia_of_numbers(std::vector{2.0, 3.0, 4.0}), Mat3(Vec3(2, 3, 4).asDiagonal()));
  Mat3 matrix;
  matrix << 5, 1, 0.5, 1, 6, -1, 0.5, -1, 7;
  EXPECT_EQ(inertia_of_numbers(row_by_row(matrix)), matrix);
}

TEST(Inertia, OfEveryCloudOfPointsIsAccepted) {
  std::mt19937_64 random(307);
  std::normal_distribution<double> bell;
  for (int n = 0; n < 1000; ++n) {
    Mat3 inertia = Mat3::Zero();
    for (int k = 0; k < 5; ++k) {
      const Vec3 p(bell(random), bell(random), bell(random));
      inertia += p.squaredNorm() * Mat3::Identity() - p * p.transpose();
    }
    EXPECT_EQ(inertia_fault(inertia), std::nullopt);
  }
}

TEST(Inertia, OfAFlatBodyMayBeRoundedToSixDigits) {
  EXPECT_EQ(inertia_of_numbers(std::vector{0.333333, 0.333333, 0.666667})(2, 2), 0.666667);
}

TEST(Inertia, IsRefusedIfNoBodyHasIt) {
  EXPECT_TRUE(
      contains(inertia_error({1.0, 1.0, 2.01}), "the largest exceeds the sum of the other two"));
  EXPECT_TRUE(contains(inertia_error({0.0, 1.0, 1.0}), "are not all above 0"));
  EXPECT_TRUE(contains(inertia_error({-1.0, 1.0, 1.0}), "are not all above 0"));
  // Moments that are right, in axes that are turned; and the same with the largest too large.
  const Mat3 turn = Eigen::AngleAxisd(0.8, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  const auto turned = [&](const Vec3& moments) {
    return row_by_row(turn * moments.asDiagonal() * turn.transpose());
  };
  EXPECT_EQ(inertia_of_numbers(turned({1.0, 2.0, 2.9})).rows(), 3);
  EXPECT_TRUE(contains(inertia_error(turned({1.0, 2.0, 3.1})), "1, 2 and 3.1 kg m^2"));
  EXPECT_TRUE(contains(inertia_error(turned({0.0, 2.0, 2.0})), "are not all above 0"));
}

TEST(Inertia, IsRefusedIfItsNumbersAreWrong) {
  EXPECT_TRUE(contains(inertia_error({1.0, 1.0, 1.0, 0.0, 0.0, 0.0}), "6 are given"));
  EXPECT_TRUE(contains(inertia_error({}), "0 are given"));
  EXPECT_TRUE(
      contains(inertia_error({1.0, 1.0, std::numeric_limits<double>::quiet_NaN()}), "not finite"));
  EXPECT_TRUE(contains(inertia_error({5, 1, 0, 0, 6, 0, 0, 0, 7}),
                       "row 1 has 1 kg m^2 in column 2, and row 2 has 0 in column 1"));
}

}  // namespace
}  // namespace tactus::host
