// The stiffness of potential fields of boxes where several push is compared with the slope of the
// summed force field, by differences over a grid.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <numbers>
#include <optional>
#include <random>
#include <span>
#include <vector>

#include "firmware/safety/certificate.h"
#include "firmware/safety/stiffness_sum.h"
#include "rendering/contact/potential_field.h"
#include "tests/support/share.h"

namespace tactus::firmware {
namespace {

using rendering::Object;

constexpr double kCornerTool_m = 0.002;

Object box_field(const Vec3& place_W, const Vec3& half_m, double stiffness_N_per_m,
                 const Mat3& rotation = Mat3::Identity()) {
  Object object;
  object.surface = rendering::SurfaceKind::primitive;
  object.method = rendering::ContactMethod::potential_field;
  object.primitive.kind = rendering::PrimitiveKind::box;
  object.primitive.X_WO = {.rotation = rotation, .translation = place_W};
  object.primitive.dimensions_m = {half_m.x(), half_m.y(), half_m.z()};
  object.material.stiffness_N_per_m = stiffness_N_per_m;
  return object;
}

Mat3 turned(double angle, const Vec3& about = Vec3::UnitZ()) {
  return Eigen::AngleAxisd(angle, about.normalized()).toRotationMatrix();
}

Vec3 force_at(std::span<const Object> objects, const Vec3& p_W, double radius_m) {
  Vec3 sum = Vec3::Zero();
  for (const Object& object : objects) {
    const auto push = rendering::potential_field(object.primitive, p_W, radius_m);
    sum += object.material.stiffness_N_per_m * push.depth_m * push.normal_W;
  }
  return sum;
}

// Returns the largest stiffness at p_W, N/m: the largest eigenvalue of the force's slope, by
// differences. An edge that turns the force without holding the tool has an eigenvalue below zero.
// Returns nothing if the force jumps: then the differences to the two sides are not alike.
std::optional<double> stiffness_at(std::span<const Object> objects, const Vec3& p_W,
                                   double radius_m) {
  constexpr double kStep_m = 1e-8;
  const Vec3 here = force_at(objects, p_W, radius_m);
  Mat3 slope;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 step = kStep_m * Vec3::Unit(axis);
    const Vec3 ahead = (here - force_at(objects, p_W + step, radius_m)) / kStep_m;
    const Vec3 behind = (force_at(objects, p_W - step, radius_m) - here) / kStep_m;
    if ((ahead - behind).norm() > 1.0) {
      return std::nullopt;
    }
    slope.col(axis) = 0.5 * (ahead + behind);
  }
  const Mat3 symmetric = 0.5 * (slope + slope.transpose());
  return Eigen::SelfAdjointEigenSolver<Mat3>(symmetric).eigenvalues()[2];
}

// The stiffest place of a grid over a cube about the origin, N/m. The grid has so many steps along
// an edge, or as few as meet every part of these scenes.
double stiffest(std::span<const Object> objects, double half_m, int most_steps, double radius_m) {
  constexpr int kLeastSteps = 26;
  const int steps = std::max(kLeastSteps, testing::part_of(most_steps));
  double most = 0.0;
  for (int i = 0; i < steps * steps * steps; ++i) {
    const std::array<int, 3> cell{i % steps, i / steps % steps, i / steps / steps};
    const Vec3 share(cell[0], cell[1], cell[2]);
    const Vec3 p_W = half_m * (2.0 * (share + Vec3(0.47, 0.53, 0.51)) / steps - Vec3::Ones());
    most = std::max(most, stiffness_at(objects, p_W, radius_m).value_or(0.0));
  }
  return most;
}

StiffnessCertificate up_to(double stiffness_N_per_m) {
  StiffnessCertificate certificate;
  certificate.count = 1;
  certificate.points[0].stiffness_N_per_m = stiffness_N_per_m;
  return certificate;
}

std::optional<UncertifiedPart> refused_up_to(std::span<const Object> objects, double limit_N_per_m,
                                             double radius_m = kCornerTool_m) {
  return first_uncertified(up_to(limit_N_per_m), objects, {},
                           {.tool_radius_m = radius_m, .max_force_N = 8.0});
}

// Two plates through one another at that angle, whose ends are far from one another.
std::array<Object, 2> crossed_plates(double angle) {
  return {box_field(Vec3::Zero(), {0.1, 0.004, 0.05}, 900.0),
          box_field(Vec3::Zero(), {0.05, 0.004, 0.07}, 700.0, turned(angle))};
}

TEST(FieldCorner, PlatesThatCrossAtARightAngleAreAsStiffAsTheStifferOne) {
  const auto plates = crossed_plates(std::numbers::pi / 2.0);
  EXPECT_NEAR(stiffest(plates, 0.02, 60, kCornerTool_m), 900.0, 0.1);
  EXPECT_FALSE(refused_up_to(plates, 901.0));
  EXPECT_TRUE(refused_up_to(plates, 899.0));
}

// If their ends are in one plane, both push along its normal.
TEST(FieldCorner, PlatesThatCrossAndEndInOnePlaneCountWithTheSumThere) {
  const std::array plates{box_field(Vec3::Zero(), {0.05, 0.004, 0.015}, 900.0),
                          box_field(Vec3::Zero(), {0.004, 0.05, 0.015}, 700.0)};
  EXPECT_NEAR(stiffest(plates, 0.02, 60, kCornerTool_m), 1600.0, 0.1);
  EXPECT_TRUE(refused_up_to(plates, 1599.0));
}

TEST(FieldCorner, PlatesThatCrossCountByTheAngleBetweenThem) {
  for (const double angle : {0.6, 1.0, 1.3}) {
    const auto plates = crossed_plates(angle);
    // The largest eigenvalue of 900 n n^T + 700 m m^T.
    const double cosine = std::cos(angle);
    const double most =
        0.5 * (1600.0 + std::sqrt(200.0 * 200.0 + 4.0 * 900.0 * 700.0 * cosine * cosine));
    EXPECT_NEAR(stiffest(plates, 0.015, 60, kCornerTool_m), most, 0.1);
    const auto part = refused_up_to(plates, most - 1.0);
    ASSERT_TRUE(part) << angle;
    EXPECT_NEAR(part->stiffness_N_per_m, most, 0.1);
    EXPECT_FALSE(refused_up_to(plates, most + 0.1)) << angle;
  }
}

TEST(FieldCorner, ThreePlatesThatCrossAtRightAnglesAreAsStiffAsTheStiffestOne) {
  const std::array plates{box_field(Vec3::Zero(), {0.05, 0.004, 0.06}, 900.0),
                          box_field(Vec3::Zero(), {0.004, 0.05, 0.07}, 800.0),
                          box_field(Vec3::Zero(), {0.07, 0.06, 0.004}, 700.0)};
  EXPECT_NEAR(stiffest(plates, 0.02, 60, kCornerTool_m), 900.0, 0.1);
  EXPECT_FALSE(refused_up_to(plates, 901.0));
}

// Below the edge of a wall that only stands on the floor, the one pushes up and the other down.
TEST(FieldCorner, AWallThatEndsAtTheFloorCountsWithTheSum) {
  const std::array objects{box_field({0.0, -0.01, 0.0}, {0.05, 0.01, 0.05}, 900.0),
                           box_field({-0.005, 0.02, 0.0}, {0.005, 0.02, 0.05}, 700.0)};
  EXPECT_GT(stiffest(objects, 0.01, 80, kCornerTool_m), 1590.0);
  EXPECT_TRUE(refused_up_to(objects, 1599.0));
}

// One that goes on below it is never felt up or down where the floor is.
TEST(FieldCorner, AWallThatGoesThroughTheFloorCountsAsTheStifferOfTheTwo) {
  const std::array objects{box_field({0.0, -0.01, 0.0}, {0.05, 0.01, 0.05}, 900.0),
                           box_field({-0.005, 0.0, 0.0}, {0.005, 0.05, 0.08}, 700.0)};
  EXPECT_NEAR(stiffest(objects, 0.03, 80, kCornerTool_m), 900.0, 0.1);
  EXPECT_FALSE(refused_up_to(objects, 901.0));
}

TEST(FieldCorner, FieldsSideBySideCountWithTheSum) {
  for (const double radius_m : {0.0, kCornerTool_m}) {
    const std::array objects{box_field(Vec3::Zero(), {0.01, 0.01, 0.01}, 900.0),
                             box_field({0.0, 0.005, 0.0}, {0.01, 0.01, 0.01}, 700.0)};
    EXPECT_NEAR(stiffest(objects, 0.02, 40, radius_m), 1600.0, 0.1);
    EXPECT_TRUE(refused_up_to(objects, 1599.0, radius_m));
  }
}

TEST(FieldCorner, AFieldCountsWithASpringThatIsAlikeInAllDirections) {
  const std::array objects{box_field(Vec3::Zero(), {0.01, 0.01, 0.01}, 900.0)};
  const std::array effects{
      rendering::Effect{.law = rendering::Spring{.stiffness_N_per_m = 200.0}, .max_force_N = 20.0}};
  EXPECT_TRUE(first_uncertified(up_to(1099.0), objects, effects));
  EXPECT_FALSE(first_uncertified(up_to(1100.1), objects, effects));
}

// Without looks left, fields count as alike in all directions.
TEST(FieldCorner, ASearchThatRunsOutCountsTheSum) {
  const auto plates = crossed_plates(std::numbers::pi / 2.0);
  const FeltScene scene{.objects = plates, .feel = {.tool_radius_m = kCornerTool_m}};
  const std::array parts{part_of(scene, 0), part_of(scene, 1)};
  const rendering::Bounds box = common_box(parts[0].region.box, parts[1].region.box);
  for (const std::size_t looks : std::array<std::size_t, 4>{0, 1, 10, 100}) {
    std::size_t left = looks;
    EXPECT_NEAR(stiffness_together(box, parts, 0.0, left), 1600.0, 1e-6) << looks;
  }
  std::size_t left = 10'000;
  EXPECT_NEAR(stiffness_together(box, parts, 1599.0, left), 900.0, 1e-6);
  std::printf("%zu looks\n", std::size_t{10'000} - left);
  EXPECT_NEAR(stiffness_together(box, parts, 1601.0, left), 1600.0, 1e-6) << "that is enough";
}

// A limit that is a little lower than the stiffest place is never certified, whatever the boxes.
TEST(FieldCorner, NoPlaceIsStifferThanTheCheckSays) {
  constexpr unsigned kSeed = 4409;
  std::mt19937 random(kSeed);
  const auto uniform = [&](double least, double most) {
    return std::uniform_real_distribution(least, most)(random);
  };
  const auto vector = [&](double least, double most) {
    const double x = uniform(least, most);
    const double y = uniform(least, most);
    return Vec3(x, y, uniform(least, most));
  };
  double counted = 0.0;
  double felt = 0.0;
  double plain = 0.0;
  const int scenes = std::max(20, testing::share_of(200));
  for (int scene = 0; scene < scenes; ++scene) {
    const double radius_m = scene % 4 == 0 ? 0.0 : uniform(0.0005, 0.004);
    std::vector<Object> objects;
    double sum = 0.0;
    for (int i = 0; i < 2 + scene % 2; ++i) {
      const Mat3 rotation =
          scene % 3 == 0 ? turned(uniform(0.0, 3.0), vector(-1.0, 1.0)) : Mat3::Identity();
      objects.push_back(
          box_field(vector(-0.01, 0.01), vector(0.002, 0.02), uniform(200.0, 900.0), rotation));
      sum += objects.back().material.stiffness_N_per_m;
    }
    const double most = stiffest(objects, 0.03, 26, radius_m);
    const auto part = refused_up_to(objects, 0.995 * most, radius_m);
    ASSERT_TRUE(part) << "seed " << kSeed << ", scene " << scene << ": " << most << " N/m";
    // The least limit at which the check lets the scene pass.
    double low = most;
    double high = 1.001 * sum;
    while (high - low > 0.1) {
      const double middle = 0.5 * (low + high);
      (refused_up_to(objects, middle, radius_m) ? low : high) = middle;
    }
    counted += high;
    felt += most;
    plain += sum;
  }
  std::printf("felt %.0f, counted %.0f, plain sums %.0f N/m on average\n", felt / scenes,
              counted / scenes, plain / scenes);
  EXPECT_LT(counted, plain);
}

}  // namespace
}  // namespace tactus::firmware
