// The spring of a surface that the hand has not pressed, and the seam between a soft surface and a
// hard one. The oracles are the spring's closed form, its energy, and the work along closed paths.
#include "rendering/contact/unpressed_depth.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <random>
#include <vector>

#include "rendering/contact/dual_basis.h"
#include "rendering/world/world.h"

namespace tactus::rendering {
namespace {

constexpr std::uint32_t kSoftPlate = 0;
constexpr std::uint32_t kHardPlate = 1;
constexpr double kSoft_N_per_m = 200.0;
constexpr double kHard_N_per_m = 1000.0;

ContactPlane plane_of(std::uint32_t object, const Vec3& normal = Vec3::UnitY()) {
  return {.plane = {.normal = normal, .offset = 0.0}, .object = object};
}

// A proxy that first a soft plate holds, and then a hard one.
class UnpressedDepth : public ::testing::Test {
 protected:
  UnpressedDepth() {
    const std::array stiffness_N_per_m{kSoft_N_per_m, kHard_N_per_m};
    for (std::size_t i = 0; i < 2; ++i) {
      plates_[i] = {.surface = SurfaceKind::primitive,
                    .primitive = {.kind = PrimitiveKind::plane},
                    .material = {.stiffness_N_per_m = stiffness_N_per_m[i]},
                    .moves = true};
    }
    EXPECT_TRUE(scene_->set(plates_));
  }

  // Ends a tick in which these planes hold the proxy, and the tool moved by `step_W`, m.
  struct Pressed {
    ContactPlane plane;
    double pressure_m = 0.0;
  };
  void end_tick(const std::vector<Pressed>& pressed, const Vec3& step_W) {
    ProxyRest rest{.plane_count = static_cast<std::uint8_t>(pressed.size())};
    for (std::size_t i = 0; i < pressed.size(); ++i) {
      rest.planes[i] = pressed[i].plane;
      rest.pressure_m[i] = pressed[i].pressure_m;
    }
    depths_.end_tick(*scene_, rest, {.p_W = Vec3::Zero(), .tool_step_W = step_W});
  }
  // Returns the force of the hard plate at that pressure, N.
  [[nodiscard]] double force_N(double pressure_m, const Vec3& normal = Vec3::UnitY()) const {
    const PlaneSpring spring =
        depths_.spring(plane_of(kHardPlate, normal), pressure_m, kHard_N_per_m);
    return spring.stiffness_N_per_m * pressure_m + spring.rise_N;
  }

  std::array<Object, 2> plates_;
  std::unique_ptr<SceneObjects> scene_ = std::make_unique<SceneObjects>();
  UnpressedDepths depths_;
};

TEST_F(UnpressedDepth, CountsAtTheStiffnessOfTheSofterSurface) {
  end_tick({{plane_of(kSoftPlate), 0.002}}, Vec3::Zero());
  end_tick({{plane_of(kHardPlate), 0.002}}, Vec3::Zero());
  EXPECT_NEAR(force_N(0.001), kSoft_N_per_m * 0.001, 1e-12);
  EXPECT_NEAR(force_N(0.002), kSoft_N_per_m * 0.002, 1e-12);
  EXPECT_NEAR(force_N(0.003), kSoft_N_per_m * 0.002 + kHard_N_per_m * 0.001, 1e-12);
}

TEST_F(UnpressedDepth, GivesTheEnergyOfItsForce) {
  end_tick({{plane_of(kSoftPlate), 0.002}}, Vec3::Zero());
  end_tick({{plane_of(kHardPlate), 0.002}}, Vec3::Zero());
  double energy_J = 0.0;
  constexpr double kStep_m = 1e-6;
  for (int i = 0; i < 4000; ++i) {
    const double pressure_m = kStep_m * i;
    energy_J += 0.5 * kStep_m * (force_N(pressure_m) + force_N(pressure_m + kStep_m));
    const double next_m = pressure_m + kStep_m;
    const PlaneSpring spring = depths_.spring(plane_of(kHardPlate), next_m, kHard_N_per_m);
    ASSERT_NEAR(0.5 * spring.stiffness_N_per_m * next_m * next_m, energy_J, 1e-12);
  }
}

TEST_F(UnpressedDepth, EndsWithTheToolsRetreat) {
  end_tick({{plane_of(kSoftPlate), 0.002}}, Vec3::Zero());
  end_tick({{plane_of(kHardPlate), 0.002}}, Vec3::Zero());
  end_tick({{plane_of(kHardPlate), 0.0005}}, 0.0015 * Vec3::UnitY());
  end_tick({{plane_of(kHardPlate), 0.003}}, -0.0025 * Vec3::UnitY());
  EXPECT_NEAR(force_N(0.003), kSoft_N_per_m * 0.0005 + kHard_N_per_m * 0.0025, 1e-12);
  end_tick({}, 0.01 * Vec3::UnitY());
  EXPECT_NEAR(force_N(0.003), kHard_N_per_m * 0.003, 1e-12);
}

TEST_F(UnpressedDepth, IsNoneWhereTheHandOrTheSurfacePresses) {
  end_tick({{plane_of(kSoftPlate), 0.002}}, Vec3::Zero());
  end_tick({{plane_of(kSoftPlate), 0.002}, {plane_of(kHardPlate, Vec3::UnitX()), 0.001}},
           -0.001 * Vec3::UnitX());
  EXPECT_NEAR(force_N(0.001, Vec3::UnitX()), kHard_N_per_m * 0.001, 1e-12);
  const Vec3 toward_tool_W{2.0, 0.0, 0.0};  // m/s, 2 mm in a tick
  ASSERT_TRUE(scene_->set_pose(kHardPlate, {}, {.linear_W = toward_tool_W}));
  scene_->begin_tick(1e-3, 1e-3);
  end_tick({{plane_of(kSoftPlate), 0.002}, {plane_of(kHardPlate, Vec3::UnitX()), 0.003}},
           Vec3::Zero());
  EXPECT_NEAR(force_N(0.003, Vec3::UnitX()), kHard_N_per_m * 0.003, 1e-12);
}

TEST_F(UnpressedDepth, IsNoneOnASurfaceThatIsSofterThanTheOneBefore) {
  end_tick({{plane_of(kHardPlate), 0.002}}, Vec3::Zero());
  end_tick({{plane_of(kSoftPlate), 0.002}}, Vec3::Zero());
  const PlaneSpring spring = depths_.spring(plane_of(kSoftPlate), 0.002, kSoft_N_per_m);
  EXPECT_EQ(spring.stiffness_N_per_m, kSoft_N_per_m);
  EXPECT_EQ(spring.rise_N, 0.0);
}

TEST_F(UnpressedDepth, IsNoneOnASurfaceThatBecomesStifferWithTime) {
  end_tick({{plane_of(kSoftPlate), 0.002}}, Vec3::Zero());
  ASSERT_TRUE(scene_->set_material(kSoftPlate, {.stiffness_N_per_m = kHard_N_per_m}));
  scene_->begin_tick(1e-3, 1e-3);
  end_tick({{plane_of(kSoftPlate), 0.003}}, Vec3::Zero());
  const PlaneSpring spring = depths_.spring(plane_of(kSoftPlate), 0.003, kHard_N_per_m);
  EXPECT_EQ(spring.stiffness_N_per_m, kHard_N_per_m);
  EXPECT_EQ(spring.rise_N, 0.0);
}

// Two faces of the hard plate's edge; the pressure of one of them grows without the hand.
TEST_F(UnpressedDepth, KeepsTheFacesOfOneObjectApart) {
  const ContactPlane left = plane_of(kHardPlate, -Vec3::UnitX());
  const ContactPlane front = plane_of(kHardPlate, Vec3::UnitZ());
  const Vec3 step_W{0.001, 0.0, -0.003};
  end_tick({{plane_of(kSoftPlate), 0.002}}, Vec3::Zero());
  end_tick({{plane_of(kSoftPlate), 0.002}, {left, 0.001}, {front, 0.003}}, step_W);
  end_tick({{plane_of(kSoftPlate), 0.002}, {left, 0.002}, {front, 0.003}}, Vec3::Zero());
  EXPECT_NEAR(force_N(0.002, -Vec3::UnitX()), kSoft_N_per_m * 0.001 + kHard_N_per_m * 0.001, 1e-12);
  EXPECT_NEAR(force_N(0.003, Vec3::UnitZ()), kHard_N_per_m * 0.003, 1e-12);
}

TEST(DualBasis, HasThePressuresOfAStretch) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (int i = 0; i < 300; ++i) {
    ProxyRest rest{.plane_count = static_cast<std::uint8_t>(1 + i % 3)};
    Vec3 stretch_W = Vec3::Zero();
    for (std::size_t k = 0; k < rest.plane_count; ++k) {
      const std::array<double, 3> drawn{any(random), any(random), any(random)};
      rest.planes[k].plane.normal = Vec3{drawn[0], drawn[1], drawn[2]}.normalized();
      rest.pressure_m[k] = any(random);
      stretch_W += rest.pressure_m[k] * rest.planes[k].plane.normal;
    }
    const DualBasis dual = dual_basis(rest);
    for (std::size_t k = 0; k < rest.plane_count; ++k) {
      if (dual[k] != Vec3::Zero()) {  // it is zero between parallel normals
        ASSERT_NEAR(dual[k].dot(stretch_W), rest.pressure_m[k], 1e-9);
      }
    }
  }
}

// Two boxes side by side with tops at y = 0, the softer one at x < 0.
class StiffnessSeam {
 public:
  explicit StiffnessSeam(double tool_radius_m) : radius_m_(tool_radius_m) {
    const std::array stiffness_N_per_m{kSoft_N_per_m, kHard_N_per_m};
    for (std::size_t i = 0; i < 2; ++i) {
      boxes_[i] = {.surface = SurfaceKind::primitive,
                   .primitive = {.kind = PrimitiveKind::box, .dimensions_m = {0.02, 0.01, 0.02}},
                   .material = {.stiffness_N_per_m = stiffness_N_per_m[i]}};
      boxes_[i].primitive.X_WO.translation = {i == 0 ? -0.02 : 0.02, -0.01, 0.0};
    }
    EXPECT_TRUE(world_->set_scene(boxes_, {.tool_radius_m = tool_radius_m}));
    EXPECT_TRUE(world_->set_tick(1e-3));
  }

  // Returns the force on a tool at (x, y) over the tops, N.
  Vec3 force_N(double x, double y) {
    return world_->touch({.p_W = {x, y + radius_m_, 0.0}}).force_W;
  }

 private:
  double radius_m_;
  std::array<Object, 2> boxes_;
  std::unique_ptr<World> world_ = std::make_unique<World>();
};

struct SeamPlace {
  double x = 0.0;
  double y = 0.0;
};

TEST(StiffnessSeamTest, GivesNothingOutAndDoesNotJump) {
  constexpr std::array<SeamPlace, 7> kPath{{{-0.01, 0.004},
                                            {-0.01, -0.002},
                                            {0.01, -0.002},
                                            {0.01, -0.001},
                                            {0.012, -0.003},
                                            {0.01, 0.004},
                                            {-0.01, 0.004}}};
  for (const double radius_m : {0.0, 0.002}) {
    StiffnessSeam seam(radius_m);
    Vec3 before_N = seam.force_N(kPath[0].x, kPath[0].y);
    double work_J = 0.0;
    for (std::size_t i = 1; i < kPath.size(); ++i) {
      constexpr int kSteps = 4000;
      const double dx = (kPath[i].x - kPath[i - 1].x) / kSteps;
      const double dy = (kPath[i].y - kPath[i - 1].y) / kSteps;
      for (int k = 1; k <= kSteps; ++k) {
        const Vec3 next_N = seam.force_N(kPath[i - 1].x + k * dx, kPath[i - 1].y + k * dy);
        work_J += 0.5 * (before_N + next_N).dot(Vec3{dx, dy, 0.0});
        // The hard box's spring over two steps.
        ASSERT_LE((next_N - before_N).norm(), 2.0 * kHard_N_per_m * std::hypot(dx, dy))
            << "segment " << i << ", step " << k << ", radius " << radius_m;
        before_N = next_N;
      }
    }
    EXPECT_LE(work_J, 1e-8) << "radius " << radius_m;
  }
}

// A tool that has left the hard box and comes back finds the whole of its stiffness.
TEST(StiffnessSeamTest, IsStiffAgainAfterTheToolHasLeft) {
  StiffnessSeam seam(0.0);
  seam.force_N(-0.01, 0.001);
  for (int k = -1000; k <= 1000; ++k) {
    seam.force_N(1e-5 * k, -0.002);
  }
  EXPECT_NEAR(seam.force_N(0.01, -0.002).y(), 0.002 * kSoft_N_per_m, 2e-3);
  seam.force_N(0.01, 0.001);
  EXPECT_NEAR(seam.force_N(0.01, -0.002).y(), 0.002 * kHard_N_per_m, 2e-3);
}

}  // namespace
}  // namespace tactus::rendering
