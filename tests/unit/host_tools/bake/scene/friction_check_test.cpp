#include "host_tools/bake/scene/friction_check.h"

#include <gtest/gtest.h>

#include <string>

#include "host_tools/bake/scene/bake.h"
#include "tests/support/csv.h"
#include "tests/unit/host_tools/bake/temporary_folder.h"

namespace tactus::host {
namespace {

using testing::contains;
using testing::input_error;

const std::string kHeldPlate = "[[object]]\nprimitive = \"box\"\nsize_m = [0.1, 0.02, 0.1]\n";
const std::string kBareDevice =
    "[device]\nmass_kg = 0.1\ndamping_Ns_per_m = 1.0\nrate_hz = 1000\ndelay_ticks = 0\n";

SceneDescription scene_of(const std::string& device, const std::string& object) {
  return parse_scene_description(device + kHeldPlate + object + "\n", "folder/scene.toml");
}

void require_stable(const SceneDescription& scene) {
  require_stable_friction(scene.objects.front(), scene);
}

std::string refusal(const std::string& device, const std::string& object) {
  return input_error([&] { require_stable(scene_of(device, object)); });
}

bool is_stable(const std::string& device, const std::string& object) {
  try {
    require_stable(scene_of(device, object));
    return true;
  } catch (const InputError&) {
    return false;
  }
}

std::vector<std::string> warnings_of(const std::string& friction) {
  const SceneDescription scene = scene_of("", "friction = { " + friction + " }");
  return friction_warnings(scene.objects.front(), scene);
}

std::string dahl(double stiffness_N_per_m) {
  return "friction = { model = \"dahl\", dynamic = 0.5, stiffness_N_per_m = " +
         std::to_string(stiffness_N_per_m) + " }";
}

std::string lugre(double stiffness_N_per_m, double damping_s_per_m) {
  return "friction = { model = \"lugre\", static = 0.8, dynamic = 0.5, stiffness_N_per_m = " +
         std::to_string(stiffness_N_per_m) +
         ", damping_s_per_m = " + std::to_string(damping_s_per_m) + " }";
}

// The number that follows `words` in `text`.
double advised(const std::string& text, const std::string& words) {
  const std::size_t at = text.find(words);
  EXPECT_NE(at, std::string::npos) << text;
  return at == std::string::npos ? 0.0 : std::stod(text.substr(at + words.size()));
}

const std::string kStiffnessAdvice = "a stiffness_N_per_m of at most ";
const std::string kDampingAdvice = "a damping_s_per_m of at most ";

// Every row of the exact limits: with the contact's damping as the wall's.
TEST(FrictionCheck, RefusesExactlyWhatADeviceCannotHold) {
  const testing::Csv limits("wall_Kmax_m0.1.csv");
  for (std::size_t row = 0; row < limits.rows(); ++row) {
    const std::string device = "[device]\nmass_kg = " + limits.text(row, "m_kg") +
                               "\ndamping_Ns_per_m = " + limits.text(row, "b_Ns_m") +
                               "\nrate_hz = " + limits.text(row, "f_Hz") +
                               "\ndelay_ticks = " + limits.text(row, "delay_samples") + "\n";
    const std::string contact = "damping_Ns_per_m = " + limits.text(row, "B_virtual_Ns_m") + "\n";
    const double most = limits.number(row, "K_max_exact_N_m");
    EXPECT_TRUE(is_stable(device, contact + dahl(0.9999 * most))) << "row " << row;
    const std::string message = refusal(device, contact + dahl(1.0001 * most));
    EXPECT_NEAR(advised(message, kStiffnessAdvice), most, 2e-4 * most) << "row " << row;
  }
}

TEST(FrictionCheck, NamesTheBristleTheDeviceAndTheRemedy) {
  EXPECT_EQ(refusal(kBareDevice,
                    "friction = { model = \"lugre\", static = 0.8, dynamic = 0.5, "
                    "stiffness_N_per_m = 2500, damping_s_per_m = 0.25 }"),
            "folder/scene.toml:9: box friction: bristles of 2500 N/m and 0 to 2.5 N s/m (by the "
            "normal force, up to 10 N) buzz on a device of 0.1 kg, 1 N s/m, 1000 Hz and a delay of "
            "0 ticks; write a stiffness_N_per_m of at most 2003.3; [device] says which device it "
            "is");
}

TEST(FrictionCheck, RefusesTheBristleOfTheLugrePaper) {
  EXPECT_TRUE(contains(refusal(kBareDevice, lugre(1e5, 316.228)), "write a stiffness_N_per_m of "));
}

TEST(FrictionCheck, AdvisesDampingWhereThatAloneIsTooLarge) {
  const std::string message = refusal(kBareDevice, lugre(1000.0, 40.0));
  const double most = advised(message, kDampingAdvice);
  EXPECT_TRUE(is_stable(kBareDevice, lugre(1000.0, most)));
  EXPECT_FALSE(is_stable(kBareDevice, lugre(1000.0, 1.001 * most)));
}

TEST(FrictionCheck, AdvisesBothWhereNeitherAloneSuffices) {
  const std::string message = refusal(kBareDevice, lugre(5000.0, 40.0));
  const double stiffness = advised(message, "a stiffness_N_per_m of ");
  const double damping = advised(message, "with a damping_s_per_m of at most ");
  EXPECT_TRUE(is_stable(kBareDevice, lugre(stiffness, damping)));
}

TEST(FrictionCheck, SaysWhereADeviceCanHoldNothing) {
  const std::string undamped = "[device]\ndamping_Ns_per_m = 0\n";
  EXPECT_TRUE(contains(refusal(undamped, dahl(100.0)), "it can hold none at all"));
}

// 2500 N/m are stable under 10 N, where sigma1 N is 2 N s/m, and not under a light touch, where it
// is next to nothing.
TEST(FrictionCheck, RefusesWhatALightTouchCannotHold) {
  const rendering::SampledDevice device{
      .mass_kg = 0.1, .damping_Ns_per_m = 1.0, .step_s = 1e-3, .delay_ticks = 0};
  EXPECT_LT(spectral_radius(device, {2500.0, 2.0}), 1.0);
  EXPECT_GT(spectral_radius(device, {2500.0, 0.0}), 1.0);
  EXPECT_FALSE(is_stable(kBareDevice, lugre(2500.0, 0.2)));
}

// Checking the two ends of a range is enough because there are no gaps between them.
TEST(FrictionCheck, DampingsThatADeviceHoldsHaveNoGaps) {
  for (const double damping : {0.1, 1.0, 5.0}) {
    for (const int delay : {0, 1, 4}) {
      const rendering::SampledDevice device{
          .mass_kg = 0.1, .damping_Ns_per_m = damping, .step_s = 1e-3, .delay_ticks = delay};
      const double stiffness = 0.7 * largest_stable_stiffness(device, 0.0);
      const double most = largest_stable_damping(device, stiffness);
      for (int i = 0; i < 64; ++i) {
        EXPECT_LT(spectral_radius(device, {stiffness, most * i / 64.0}), 1.0) << i;
      }
    }
  }
}

TEST(FrictionCheck, CountsWhatATextureMakesOfTheDamping) {
  const std::string texture =
      "\n[object.texture.friction]\nimage = \"a.png\"\nrange = [0.0, 10.0]\n";
  EXPECT_TRUE(is_stable(kBareDevice, lugre(1000.0, 3.0)));
  EXPECT_FALSE(is_stable(kBareDevice, lugre(1000.0, 3.0) + texture));
}

TEST(FrictionCheck, TakesTheContactsStiffnessForASpringThatHasNone) {
  const std::string friction =
      "friction = { model = \"stribeck\", static = 0.8, damping_s_per_m = 0.1 }";
  EXPECT_TRUE(is_stable(kBareDevice, "stiffness_N_per_m = 1900\n" + friction));
  EXPECT_FALSE(is_stable(kBareDevice, "stiffness_N_per_m = 2100\n" + friction));
}

TEST(FrictionCheck, LeavesSurfacesWithoutBristlesAlone) {
  const std::string weak = "[device]\ndamping_Ns_per_m = 0\n";
  EXPECT_TRUE(is_stable(weak, "stiffness_N_per_m = 1e5"));
  EXPECT_TRUE(is_stable(weak, "stiffness_N_per_m = 1e5\nfriction = { static = 0.5 }"));
  EXPECT_TRUE(
      is_stable(weak, "stiffness_N_per_m = 1e5\nfriction = { model = \"karnopp\", static = 0.5 }"));
}

TEST(FrictionCheck, TakesADeviceThatHoldsTheDefaults) {
  for (const char* model : {"dahl\", dynamic", "lugre\", static", "elasto_plastic\", static"}) {
    EXPECT_TRUE(is_stable("", std::string("friction = { model = \"") + model + " = 0.6 }"))
        << model;
  }
}

TEST(FrictionCheck, ReadsTheDevice) {
  const TargetDevice device =
      scene_of(
          "[device]\nmass_kg = 0.25\ndamping_Ns_per_m = 3.5\nrate_hz = 4000\ndelay_ticks = "
          "2\nmax_normal_force_N = 8\n",
          "")
          .device;
  EXPECT_EQ(device.device.mass_kg, 0.25);
  EXPECT_EQ(device.device.damping_Ns_per_m, 3.5);
  EXPECT_EQ(device.device.step_s, 0.25e-3);
  EXPECT_EQ(device.device.delay_ticks, 2);
  EXPECT_EQ(device.max_normal_force_N, 8.0);
  EXPECT_TRUE(contains(refusal("[device]\nmass_g = 100\n", ""),
                       ":2: [device]: unknown key 'mass_g'; wrong unit, mass is in kilograms; "
                       "write mass_kg = 0.1"));
  EXPECT_TRUE(contains(refusal("[device]\nrate_hz = 0\n", ""), "write a number above 0"));
  EXPECT_TRUE(
      contains(refusal("[device]\ndelay_ticks = 17\n", ""), "must be a whole number from 0 to 16"));
}

TEST(FrictionCheck, WarnsOfDampingThatCanGiveOutEnergy) {
  // Table I of the LuGre paper: 158.114 N s/m, 29.55 mm/s, 12.665 mm/s.
  const std::vector<std::string> warnings = warnings_of(
      "model = \"lugre\", static = 1.5, dynamic = 1, viscous_s_per_m = 0.4, "
      "stribeck_velocity_m_per_s = 0.001, stiffness_N_per_m = 1e5, damping_s_per_m = 316.228");
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_TRUE(warnings[0].starts_with(
      "folder/scene.toml:4: box friction: above 0.0127 m/s the damping of the bristles can give "
      "out energy; write a viscous_s_per_m of at least "))
      << warnings[0];
  EXPECT_NEAR(advised(warnings[0], "a viscous_s_per_m of at least "), 158.114, 0.02);
  EXPECT_NEAR(advised(warnings[0], "a damping_fade_m_per_s of at most "), 0.02955, 5e-6);
}

TEST(FrictionCheck, WarnsNoLongerWhenItsAdviceIsTaken) {
  const std::string friction =
      "model = \"elasto_plastic\", static = 0.9, dynamic = 0.35, damping_s_per_m = 17.3";
  const std::vector<std::string> warnings = warnings_of(friction);
  ASSERT_EQ(warnings.size(), 1U);
  const double viscous = advised(warnings[0], "a viscous_s_per_m of at least ");
  const double fade = advised(warnings[0], "a damping_fade_m_per_s of at most ");
  EXPECT_TRUE(warnings_of(friction + ", viscous_s_per_m = " + std::to_string(viscous)).empty());
  EXPECT_FALSE(
      warnings_of(friction + ", viscous_s_per_m = " + std::to_string(0.99 * viscous)).empty());
  EXPECT_TRUE(warnings_of(friction + ", damping_fade_m_per_s = " + std::to_string(fade)).empty());
  EXPECT_FALSE(
      warnings_of(friction + ", damping_fade_m_per_s = " + std::to_string(1.01 * fade)).empty());
}

TEST(FrictionCheck, ReachesTheReportOfTheBaking) {
  const testing::TemporaryFolder folder;
  const std::filesystem::path image = folder.path() / "scene.tactus";
  const std::filesystem::path scene =
      folder.write("scene.toml", kHeldPlate + lugre(500.0, 1.0) + "\n");
  const BakeReport report = bake_file(scene, image);
  ASSERT_EQ(report.objects[0].warnings.size(), 1U);
  EXPECT_TRUE(contains(report.objects[0].warnings[0], "can give out energy"));
  std::filesystem::remove(image);
  const std::filesystem::path stiff =
      folder.write("stiff.toml", kHeldPlate + lugre(50000.0, 1.0) + "\n");
  EXPECT_TRUE(
      contains(input_error([&] { bake_file(stiff, image); }), "stiff.toml:4: box friction"));
  EXPECT_FALSE(std::filesystem::exists(image));
}

}  // namespace
}  // namespace tactus::host
