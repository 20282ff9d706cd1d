// A needle in tissue, against a published model's trace and against the laws of energy.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <Eigen/Geometry>

#include "tests/support/csv.h"
#include "tests/unit/rendering/needle/needle_bench.h"

namespace tactus::rendering {
namespace {

using ::tactus::testing::Csv;

const Needle kTestNeedle{.length_m = 0.1, .width_m = 1e-3};
constexpr double kInsertion_m_per_s = 3e-3;

double crack_energy_J(const NeedleBench& bench, const Tissue& tissue) {
  return tissue.toughness_J_per_m2 * bench.touch().energy().crack_m2;
}

// Row by row; ten ticks between two rows.
TEST(Needle, FollowsTheReferenceTrace) {
  const Csv trace("needle_reference_trace.csv");
  Needle needle = kTestNeedle;
  needle.tip_stiffness_N_per_m = 1e6;
  NeedleBench bench({tissue_block(0.0, 0)}, {reference_tissue()}, needle);
  ASSERT_TRUE(bench.is_good());
  bench.to_depth(-1e-6);
  double last_m = -1e-6;
  double worst_N = 0.0;
  for (std::size_t i = 0; i < trace.rows(); ++i) {
    const double depth_m = trace.number(i, "tip_depth_m");
    for (int k = 1; k <= 10; ++k) {
      bench.to_depth(last_m + (depth_m - last_m) * k / 10.0);
    }
    last_m = depth_m;
    const double wanted_N = trace.number(i, "F_axial_N");
    worst_N = std::max(worst_N, std::abs(bench.axial_N() - wanted_N));
    ASSERT_NEAR(bench.axial_N(), wanted_N, 2e-3) << "row " << i << " at " << depth_m << " m";
  }
  RecordProperty("worst_N", std::to_string(worst_N));
}

TEST(Needle, WorkOfTheHandIsCracksAndFrictionAndWhatIsStoredAndFreed) {
  for (const bool is_balanced : {false, true}) {
    Tissue tissue = balanced_tissue();
    tissue.residual_m = is_balanced ? tissue.residual_m : 0.9 * puncture_depth_m(tissue);
    NeedleBench bench({tissue_block(0.0, 0)}, {tissue}, kTestNeedle);
    ASSERT_TRUE(bench.is_good());
    bench.to_depth(-1e-4);
    for (const double depth_m : {0.005, 0.03, 0.02, 0.04, 0.001, -0.001, 0.05, -0.001}) {
      bench.go_to_depth(depth_m, kInsertion_m_per_s);
      EXPECT_NEAR(bench.accounted_J(), bench.work_J(), 1e-3 * bench.work_J()) << depth_m;
      bench.hold(0.3);
      EXPECT_NEAR(bench.accounted_J(), bench.work_J(), 1e-3 * bench.work_J()) << depth_m;
    }
    EXPECT_GT(bench.touch().energy().fracture_J, 0.0);
    EXPECT_NEAR(bench.touch().energy().fracture_J, crack_energy_J(bench, tissue), 1e-12);
  }
}

TEST(Needle, FirstInsertionTakesTheEnergyOfTheCrackMoreThanTheSecond) {
  for (const double v_m_per_s : {1e-3, 3e-3}) {
    const Tissue tissue = balanced_tissue();
    NeedleBench bench({tissue_block(0.0, 0)}, {tissue}, kTestNeedle, 1e-4);
    bench.to_depth(-1e-3);
    bench.go_to_depth(0.05, v_m_per_s);
    const double first_J = bench.work_J();
    const double crack_J = crack_energy_J(bench, tissue);
    bench.go_to_depth(-1e-3, v_m_per_s);
    const double both_J = bench.work_J();
    bench.go_to_depth(0.05, v_m_per_s);
    const double second_J = bench.work_J() - both_J;
    EXPECT_NEAR(first_J - second_J, crack_J, 0.01 * crack_J);
    EXPECT_EQ(crack_energy_J(bench, tissue), crack_J) << "the second one cut again";
    EXPECT_NEAR(bench.touch().energy().crack_m2, kTestNeedle.width_m * (0.05 - tissue.residual_m),
                0.01 * kTestNeedle.width_m * 0.05);
  }
}

TEST(Needle, ForceDropsAtThePunctureAndNeverPushesTheHand) {
  NeedleBench bench({tissue_block(0.0, 0)}, {reference_tissue()}, kTestNeedle);
  bench.to_depth(-1e-4);
  double before_N = 0.0;
  double most_N = 0.0;
  for (double depth_m = 0.0; depth_m < 0.02; depth_m += 3e-6) {
    const double force_N = bench.to_depth(depth_m).force_W.y();
    EXPECT_GE(force_N, 0.0) << depth_m;
    if (bench.touch().layers()[0].phase == LayerPhase::pierced && most_N == 0.0) {
      most_N = before_N;
      EXPECT_LT(force_N, before_N);
      EXPECT_GT(bench.touch().energy().freed_J, 0.0);
    }
    before_N = force_N;
  }
  EXPECT_NEAR(most_N, reference_tissue().puncture_force_N, 3e-3);
}

// Paths are sums of slow waves about the surface; each begins and ends at one place outside.
TEST(Needle, NoPathGivesTheHandMoreThanItHasStored) {
  std::mt19937_64 random(20261127);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int trial = 0; trial < 40; ++trial) {
    std::vector<Tissue> tissues;
    std::vector<Object> objects;
    double top_m = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      Tissue tissue = balanced_tissue(1.0 + 0.8 * unit(random));
      tissue.puncture_force_N *= 1.0 + 0.9 * unit(random);
      tissue.residual_m = std::max(least_residual_m(tissue, kTestNeedle),
                                   puncture_depth_m(tissue) * (0.5 + 0.5 * unit(random)));
      tissues.push_back(tissue);
      objects.push_back(tissue_block(top_m, i, -0.06 + 0.005 * static_cast<double>(i)));
      top_m -= 0.004 + 0.003 * unit(random);
    }
    NeedleBench bench(objects, tissues, kTestNeedle);
    ASSERT_TRUE(bench.is_good());
    std::array<std::array<double, 6>, 4> waves;
    for (auto& wave : waves) {
      std::ranges::generate(wave, [&] { return unit(random); });
    }
    const Vec3 start_W(0.0, 0.002, 0.0);
    const int kPathTicks = 20000;
    for (int i = 0; i <= kPathTicks; ++i) {
      const double s = 2.0 * std::numbers::pi * i / kPathTicks;
      Vec3 p_W = start_W;
      for (std::size_t k = 0; k < waves.size(); ++k) {
        const double n = static_cast<double>(k) * 2.0 + 1.0;
        p_W.x() += 1e-3 * waves[k][0] * (1.0 - std::cos(n * s));
        p_W.z() += 1e-3 * waves[k][1] * std::sin(n * s);
        p_W.y() -= 0.02 * (waves[k][2] * (1.0 - std::cos(n * s)) + waves[k][3] * std::sin(n * s));
      }
      bench.to(p_W);
      ASSERT_GE(bench.work_J(), bench.touch().stored_J() - 2e-6)
          << "trial " << trial << " tick " << i;
    }
    bench.to(Vec3(0.0, 0.002, 0.0));
    bench.hold(0.01);
    EXPECT_GE(bench.work_J(), 0.0) << trial;
    EXPECT_NEAR(bench.accounted_J(), bench.work_J(), 0.02 * bench.work_J() + 1e-5) << trial;
  }
}

TEST(Needle, OldChannelIsFreeAndANewOneBesideItIsNot) {
  NeedleBench bench({tissue_block(0.0, 0)}, {balanced_tissue()}, kTestNeedle);
  bench.to_depth(-1e-3);
  bench.go_to_depth(0.03, kInsertion_m_per_s);
  bench.go_to_depth(-1e-3, kInsertion_m_per_s);
  const double crack_m2 = bench.touch().energy().crack_m2;
  bench.go_to_depth(0.02, kInsertion_m_per_s);
  EXPECT_EQ(bench.touch().energy().crack_m2, crack_m2);
  const double in_channel_N = bench.axial_N();
  bench.go_to_depth(0.04, kInsertion_m_per_s);
  EXPECT_GT(bench.touch().energy().crack_m2, crack_m2);
  bench.go_to_depth(-1e-3, kInsertion_m_per_s);
  const double both_m2 = bench.touch().energy().crack_m2;
  bench.to({0.004, 1e-3, 0.0});
  double most_N = 0.0;
  for (double depth_m = -1e-3; depth_m < 0.02; depth_m += 3e-6) {
    most_N = std::max(most_N, bench.to({0.004, -depth_m, 0.0}).force_W.y());
  }
  EXPECT_NEAR(most_N, balanced_tissue().puncture_force_N, 0.01);
  EXPECT_GT(bench.touch().energy().crack_m2, both_m2);
  EXPECT_GT(bench.axial_N(), in_channel_N + 0.4);
}

TEST(Needle, IsHeldSidewaysWithAStiffnessPerLength) {
  const Tissue tissue = balanced_tissue();
  NeedleBench bench({tissue_block(0.0, 0)}, {tissue}, kTestNeedle);
  bench.to_depth(-1e-3);
  bench.go_to_depth(0.03, kInsertion_m_per_s);
  const double length_m = 0.03 - tissue.residual_m;
  for (int i = 1; i <= 100; ++i) {
    bench.to({1e-5 * i, -0.03, 0.0});
  }
  const Vec3 force_W = bench.to({1e-3, -0.03, 0.0}).force_W;
  EXPECT_NEAR(force_W.x(), -tissue.lateral_stiffness_N_per_m2 * length_m * 1e-3, 1e-6);
  EXPECT_EQ(force_W.z(), 0.0);
}

TEST(Needle, AtRestItKeepsTheFrictionAndJustDoesNotCut) {
  const Tissue tissue = balanced_tissue();
  NeedleBench bench({tissue_block(0.0, 0)}, {tissue}, kTestNeedle);
  bench.to_depth(-1e-3);
  bench.go_to_depth(0.03, kInsertion_m_per_s);
  bench.hold(3.0);
  const double length_m = 0.03 - tissue.residual_m;
  EXPECT_NEAR(bench.axial_N(),
              tissue.in.dynamic_N_per_m * length_m + fracture_force_N(tissue, kTestNeedle), 1e-3);
}

// The springs reach their limits within a way that is short against the layers.
TEST(Needle, PassesLayersInTheOrderOfTheAxisWhateverTheirOrderInTheScene) {
  const std::array<double, 3> tops{0.0, -0.01, -0.03};
  std::vector<double> forces_N;
  for (const auto& numbers : {std::array<std::size_t, 3>{0, 1, 2}, {2, 0, 1}, {1, 2, 0}}) {
    std::vector<Object> objects;
    std::vector<Tissue> tissues;
    for (const std::size_t number : numbers) {
      objects.push_back(tissue_block(tops[number], objects.size()));
      tissues.push_back(balanced_tissue(0.5 + static_cast<double>(number)));
    }
    NeedleBench bench(objects, tissues, kTestNeedle);
    bench.to_depth(-1e-3);
    std::size_t k = 0;
    for (double depth_m = -1e-3; depth_m < 0.06; depth_m += 3e-5, ++k) {
      const double force_N = bench.to_depth(depth_m).force_W.y();
      if (forces_N.size() <= k) {
        forces_N.push_back(force_N);
      }
      EXPECT_NEAR(force_N, forces_N[k], 1e-12) << depth_m;
    }
    EXPECT_EQ(bench.touch().layers().size(), 3U);
    EXPECT_TRUE(std::ranges::all_of(bench.touch().layers(), [](const NeedleLayer& layer) {
      return layer.phase == LayerPhase::pierced;
    }));
  }
}

TEST(Needle, LayerThatItBeginsInIsFeltOnceItHasBeenOut) {
  NeedleBench bench({tissue_block(0.0, 0)}, {balanced_tissue()}, kTestNeedle);
  bench.to_depth(0.02);
  bench.go_to_depth(0.03, kInsertion_m_per_s);
  EXPECT_TRUE(bench.to_depth(0.03).has_left_out);
  EXPECT_EQ(bench.axial_N(), 0.0);
  bench.go_to_depth(-0.001, kInsertion_m_per_s);
  bench.go_to_depth(0.002, kInsertion_m_per_s);
  EXPECT_GT(bench.axial_N(), 0.0);
}

// The layer turns about the point where the needle came in: the needle, whose axis stays, is
// another one to it.
TEST(Needle, ChangeOfDirectionBendsTheShaftAndLeavesTheOldChannel) {
  Object turning = tissue_block(0.0, 0);
  turning.moves = true;
  const Tissue tissue = balanced_tissue();
  NeedleBench bench({turning}, {tissue}, kTestNeedle);
  bench.to_depth(-1e-3);
  bench.go_to_depth(0.04, kInsertion_m_per_s);
  bench.hold(3.0);
  const double crack_m2 = bench.touch().energy().crack_m2;
  const auto turn_to = [&](double angle) {
    const Mat3 rotation = Eigen::AngleAxisd(angle, Vec3::UnitZ()).toRotationMatrix();
    ASSERT_TRUE(bench.scene().set_pose(0, {rotation, Vec3::Zero()}, {}));
  };
  constexpr double kAngle = 0.1;
  for (int i = 1; i <= 100; ++i) {
    turn_to(kAngle * i / 100.0);
    bench.to_depth(0.04);
  }
  // The tissue carries the middle of the shaft along.
  const double length_m = 0.04 - tissue.residual_m;
  const double aside_m = (0.04 - 0.5 * length_m) * std::sin(kAngle);
  const double stiffness = tissue.lateral_stiffness_N_per_m2 * length_m;
  EXPECT_NEAR(bench.to_depth(0.04).force_W.x(), stiffness * aside_m, 0.02 * stiffness * aside_m);
  EXPECT_NEAR(bench.touch().energy().crack_m2, crack_m2, 1e-9);
  bench.go_to_depth(-1e-3, kInsertion_m_per_s);
  bench.go_to_depth(0.03, kInsertion_m_per_s);
  EXPECT_NEAR(bench.touch().energy().crack_m2 - crack_m2,
              kTestNeedle.width_m * (0.03 - tissue.residual_m), 0.05 * kTestNeedle.width_m * 0.03)
      << "the channel of another direction is cut anew";
}

// Thin layers lie before the depth at which the outermost gives way.
TEST(Needle, RecoilPiercesOnlyWhatItsEnergyPaysFor) {
  for (const double inner_scale : {0.05, 20.0}) {
    Tissue outer = balanced_tissue();
    outer.residual_m = 0.0;
    outer.cutting_force_N = 0.1;
    outer.toughness_J_per_m2 = 20.0;
    Tissue inner = balanced_tissue(inner_scale);
    inner.puncture_force_N = 0.3 * inner_scale;
    inner.residual_m = balanced_residual_m(inner);
    NeedleBench bench({tissue_block(0.0, 0), tissue_block(-0.002, 1, -0.19)}, {outer, inner},
                      kTestNeedle);
    bench.to_depth(-1e-3);
    double most_N = 0.0;
    for (double depth_m = 0.0; depth_m < puncture_depth_m(outer) + 1e-5; depth_m += 3e-6) {
      most_N = std::max(most_N, bench.to_depth(depth_m).force_W.y());
    }
    const auto layers = bench.touch().layers();
    EXPECT_EQ(layers[0].phase, LayerPhase::pierced);
    EXPECT_EQ(layers[1].phase, inner_scale < 1.0 ? LayerPhase::pierced : LayerPhase::pressed);
    EXPECT_LE(bench.axial_N(), most_N);
    EXPECT_NEAR(bench.accounted_J(), bench.work_J(), 1e-3 * bench.work_J());
  }
}

}  // namespace
}  // namespace tactus::rendering
