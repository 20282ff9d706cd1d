// Needles and tissue from the text of a scene to the force on the hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>

#include "host_tools/bake/scene/bake.h"
#include "host_tools/bake/scene/mapped_scene.h"
#include "host_tools/bake/scene/scene_description.h"
#include "rendering/scene/scene_world.h"
#include "rendering/world/world.h"
#include "tests/support/paths.h"
#include "tests/unit/host_tools/bake/temporary_folder.h"

namespace tactus::testing {
namespace {

using rendering::Tissue;
using rendering::World;

const std::string kNeedleTable = "[tool.needle]\nlength_m = 0.1\nwidth_m = 1e-3\n";
const std::string kBlockText =
    "[[object]]\nname = \"block\"\nprimitive = \"box\"\nsize_m = [0.1, 0.1, 0.1]\n";
const std::string kTissueTable = "[object.tissue]\n";

std::string needle_refusal(const std::string& text) {
  return input_error([&] { host::parse_scene_description(text, "folder/scene.toml"); });
}
Tissue parsed_tissue(const std::string& keys) {
  return *host::parse_scene_description(kNeedleTable + kBlockText + kTissueTable + keys,
                                        "scene.toml")
              .objects[0]
              .tissue;
}

TEST(NeedleScene, HasTheTissueThatItDescribes) {
  const Tissue tissue = parsed_tissue(
      "stiffness_N_per_m = 20.0\nstiffness_N_per_m2 = 8000.0\npuncture_force_N = 1.392\n"
      "residual_m = 0.004\ncutting_force_N = 0.94\ntoughness_J_per_m2 = 100.0\n"
      "static_N_per_m = 18.45\ndynamic_N_per_m = 10.37\nviscous_Ns_per_m2 = 212.13\n"
      "withdrawal = { static_N_per_m = 18.23, dynamic_N_per_m = 10.57, viscous_Ns_per_m2 = 293.08 "
      "}\nlateral_stiffness_N_per_m2 = 2e4\nrelaxation_s = 0.2\nshaft_stiffness_N_per_m2 = 4e4\n");
  EXPECT_EQ(tissue.stiffness_N_per_m2, 8000.0);
  EXPECT_EQ(tissue.residual_m, 0.004);
  EXPECT_EQ(tissue.toughness_J_per_m2, 100.0);
  EXPECT_EQ(tissue.in.static_N_per_m, 18.45);
  EXPECT_EQ(tissue.out.dynamic_N_per_m, 10.57);
  EXPECT_EQ(tissue.lateral_stiffness_N_per_m2, 2e4);
  EXPECT_EQ(tissue.relaxation_s, 0.2);
  EXPECT_EQ(tissue.shaft_stiffness_N_per_m2, 4e4);
  EXPECT_NEAR(puncture_depth_m(tissue), 0.012, 1e-12);
}

TEST(NeedleScene, LeavesOutWhatFollows) {
  const Tissue tissue =
      parsed_tissue("cutting_force_N = 0.5\ndynamic_N_per_m = 10.0\nclamping = 1.5\n");
  EXPECT_NEAR(tissue.toughness_J_per_m2, 500.0, 1e-9);
  EXPECT_EQ(tissue.in.static_N_per_m, 10.0);
  EXPECT_EQ(tissue.out.dynamic_N_per_m, 15.0);
  EXPECT_NEAR(parsed_tissue("toughness_J_per_m2 = 200.0\n").cutting_force_N, 0.2, 1e-12);
  // The energy that the surface stored pays for the way to the tip: 1 N/mm to 1 N is 0.5 mJ, which
  // at 1 N is half a millimetre.
  EXPECT_NEAR(
      parsed_tissue("stiffness_N_per_m = 1000.0\npuncture_force_N = 1.0\ncutting_force_N = 1.0")
          .residual_m,
      0.0005, 1e-12);
}

TEST(NeedleScene, RefusesWhatANeedleCannotPierce) {
  const auto refused = [](const std::string& text, std::string_view why) {
    const std::string error = needle_refusal(text);
    EXPECT_TRUE(contains(error, why)) << error;
  };
  refused(kBlockText + kTissueTable, "there is none; add [tool.needle] with length_m");
  refused(kNeedleTable + kBlockText + "[object.body]\n" + kTissueTable,
          "leave out the body or the tissue");
  refused(
      kNeedleTable + "[[object]]\nformula = \"x^2 + y^2 + z^2 - 1\"\nscale = 0.01\n" + kTissueTable,
      "contact = \"sphere_proxy\"");
  refused("[tool.needle]\n" + kBlockText, "length_m is missing");
  refused("[tool.needle]\nlength_m = 90.0\n" + kBlockText, "is it in millimetres?");
  refused("[tool.needle]\nlength_m = 0.09\naxis = [0.0, 0.0, 0.0]\n" + kBlockText,
          "axis has no length");
  const std::string tissue = kNeedleTable + kBlockText + kTissueTable;
  refused(tissue + "puncture_force_N = 1.0\n", "it never reaches puncture_force_N");
  refused(tissue + "cutting_force_N = 0.5\ntoughness_J_per_m2 = 600.0\n",
          "write toughness_J_per_m2 = 500 or less");
  refused(tissue + "static_N_per_m = 1.0\ndynamic_N_per_m = 2.0\n", "more than static_N_per_m");
  refused(tissue + "clamping = 2.0\nwithdrawal = { dynamic_N_per_m = 1.0 }\n",
          "leave one of the two out");
  const std::string membrane = "stiffness_N_per_m = 1000.0\npuncture_force_N = 1.0\n";
  refused(tissue + membrane + "residual_m = 0.002\n", "gives way at 0.001 m");
  refused(tissue + membrane + "cutting_force_N = 1.0\nresidual_m = 0.0004\n",
          "where 0.0005 m is the least");
  refused(tissue + "cutting_force_mN = 1.0\n", "cutting_force_N");
  std::string many = kNeedleTable;
  for (int i = 0; i < 17; ++i) {
    many +=
        "[[object]]\nname = \"" + std::to_string(i) + "\"\nprimitive = \"plane\"\n" + kTissueTable;
  }
  refused(many, "17 objects with tissue, where 16 fit");
}

// The needle of the example goes in at 10 mm/s: five surfaces would give way; it stops before the
// last one.
TEST(NeedleScene, EpiduralLosesItsResistanceBehindTheLigament) {
  const TemporaryFolder folder;
  const std::filesystem::path image = folder.path() / "epidural.tactus";
  host::bake_file(in_repository("host_tools/examples/epidural/scene.toml"), image, {});
  const host::MappedScene scene(image);
  auto world = std::make_unique<World>();
  ASSERT_TRUE(world->set_scene(scene.image().objects(), rendering::world_of(scene.image())));
  double before_N = 0.0;
  double most_N = 0.0;
  double largest_drop_N = 0.0;
  double dropped_at_m = 0.0;
  double work_J = 0.0;
  for (double depth_m = -0.005; depth_m < 0.053; depth_m += 1e-5) {
    const rendering::Touch touch =
        world->touch({.p_W = {0.0, -depth_m, 0.0}, .v_W = {0.0, -0.01, 0.0}});
    const double force_N = touch.force_W.y();
    work_J += 0.5 * (force_N + before_N) * 1e-5;
    ASSERT_EQ(touch.flags, rendering::kTouchClean) << depth_m;
    ASSERT_GE(force_N, 0.0) << depth_m;
    EXPECT_EQ(touch.contact == rendering::ContactKind::none, depth_m <= 0.0) << depth_m;
    if (before_N - force_N > largest_drop_N) {
      largest_drop_N = before_N - force_N;
      dropped_at_m = depth_m;
    }
    most_N = std::max(most_N, force_N);
    before_N = force_N;
  }
  EXPECT_GT(most_N, 5.0);
  EXPECT_GT(dropped_at_m, 0.045);
  EXPECT_LT(dropped_at_m, 0.05);
  const rendering::NeedleTouch& needle = world->needle();
  const auto pierced = std::ranges::count(needle.layers(), rendering::LayerPhase::pierced,
                                          &rendering::NeedleLayer::phase);
  EXPECT_EQ(pierced, 5) << "skin, fat, muscle, ligament and the space; not the dura";
  const rendering::NeedleEnergy& energy = needle.energy();
  EXPECT_NEAR(energy.fracture_J + energy.friction_J + energy.freed_J + needle.stored_J(), work_J,
              2e-3 * work_J);
}

}  // namespace
}  // namespace tactus::testing
