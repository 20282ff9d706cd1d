#include "firmware/safety/certificate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "firmware/control/controller.h"
#include "tests/unit/firmware/test_scene.h"

namespace tactus::firmware {
namespace {

StiffnessCertificate two_points() {
  StiffnessCertificate certificate;
  certificate.count = 2;
  certificate.points[0] = {.damping_Ns_per_m = 0.0, .stiffness_N_per_m = 1000.0};
  certificate.points[1] = {.damping_Ns_per_m = 4.0, .stiffness_N_per_m = 2000.0};
  return certificate;
}

ControllerConfig certified_config() {
  ControllerConfig config = cartesian_config();
  config.certificate = two_points();
  return config;
}

TEST(Certificate, LiesOnStraightLinesBetweenItsPoints) {
  const StiffnessCertificate certificate = two_points();
  EXPECT_EQ(certified_stiffness(certificate, 0.0), 1000.0);
  EXPECT_EQ(certified_stiffness(certificate, 1.0), 1250.0);
  EXPECT_EQ(certified_stiffness(certificate, 4.0), 2000.0);
  EXPECT_EQ(certified_stiffness(certificate, 4.1), 0.0);
}

TEST(Certificate, NamesTheFirstObjectThatIsTooStiff) {
  std::array<rendering::Object, 2> objects;
  objects[0].material.stiffness_N_per_m = 1000.0;
  objects[1].material = {.stiffness_N_per_m = 1600.0, .damping_Ns_per_m = 2.0};
  const auto part = first_uncertified(two_points(), objects, {});
  ASSERT_TRUE(part);
  EXPECT_EQ(part->index, 1U);
  EXPECT_EQ(part->stiffness_N_per_m, 1600.0);
  EXPECT_EQ(part->limit_N_per_m, 1500.0);
}

TEST(Certificate, CountsATextureThatStiffens) {
  const std::array<rendering::TextureLayer, 1> layers{
      rendering::TextureLayer{.use = rendering::TextureUse::stiffness, .low = 0.5, .high = 3.0}};
  std::array<rendering::Object, 1> objects;
  objects[0].material.stiffness_N_per_m = 500.0;
  EXPECT_FALSE(first_uncertified(two_points(), objects, {}));
  objects[0].detail.layers = layers;
  EXPECT_TRUE(first_uncertified(two_points(), objects, {}));
}

TEST(Certificate, CountsTheSpringsOfEffects) {
  const std::array<rendering::Effect, 2> effects{
      rendering::Effect{.law = rendering::ConstantField{}, .max_force_N = 1.0},
      rendering::Effect{.law = rendering::Spring{.stiffness_N_per_m = 1001.0}, .max_force_N = 1.0}};
  const auto part = first_uncertified(two_points(), {}, effects);
  ASSERT_TRUE(part);
  EXPECT_EQ(part->kind, UncertifiedPart::Kind::effect);
  EXPECT_EQ(part->index, 1U);
}

// The slope of the pull by differences: the largest over distances up to ten cores.
double steepest_by_differences(double strength_N, double core_m) {
  const double c2 = core_m * core_m;
  const auto shape = [&](double d) { return d / std::pow(d * d + c2, 1.5); };
  const double scale = strength_N / shape(core_m / std::sqrt(2.0));
  const double step = 1e-4 * core_m;
  double steepest = 0.0;
  for (double d = -10.0 * core_m; d < 10.0 * core_m; d += step) {
    steepest = std::max(steepest, scale * (shape(d + step) - shape(d)) / step);
  }
  return steepest;
}

TEST(Certificate, CountsAMagnetsCoreAsTheSpringThatItIs) {
  for (const double strength_N : {2.0, -2.0}) {
    const std::array<rendering::Effect, 1> effects{rendering::Effect{
        .law = rendering::Magnet{.strength_N = strength_N, .core_m = 0.0002}, .max_force_N = 8.0}};
    const auto part = first_uncertified(two_points(), {}, effects);
    ASSERT_TRUE(part);
    const double slope = steepest_by_differences(strength_N, 0.0002);
    EXPECT_NEAR(part->stiffness_N_per_m, slope, 1e-3 * slope);
  }
}

TEST(Certificate, LetsAWideMagnetPass) {
  const std::array<rendering::Effect, 1> effects{rendering::Effect{
      .law = rendering::Magnet{.strength_N = 2.0, .core_m = 0.01}, .max_force_N = 8.0}};
  EXPECT_FALSE(first_uncertified(two_points(), {}, effects));
}

TEST(Certificate, CountsTheDragOfAFluidAtItsLargestForce) {
  rendering::FluidDrag drag{.linear_Ns_per_m = 3.9};
  const auto check = [&] {
    const std::array<rendering::Effect, 1> effects{
        rendering::Effect{.law = drag, .max_force_N = 8.0}};
    return first_uncertified(two_points(), {}, effects);
  };
  EXPECT_FALSE(check());
  drag.linear_Ns_per_m = 500.0;
  ASSERT_TRUE(check());
  EXPECT_EQ(check()->damping_Ns_per_m, 500.0);
  // 2 v^2 is 8 N at 2 m/s, and its slope there is 8 N s/m.
  drag = {.quadratic_Ns2_per_m2 = 2.0};
  ASSERT_TRUE(check());
  EXPECT_DOUBLE_EQ(check()->damping_Ns_per_m, 8.0);
}

TEST(Certificate, KeepsAStifferSceneOutOfTheControllerUnlessTold) {
  const auto controller = std::make_unique<Controller>();
  ASSERT_TRUE(controller->configure(certified_config()));
  const Floor soft({.stiffness_N_per_m = 1000.0});
  const Floor stiff({.stiffness_N_per_m = 1001.0});
  const Floor damped({.stiffness_N_per_m = 10.0, .damping_Ns_per_m = 5.0});
  EXPECT_TRUE(controller->load_scene(soft.objects(), {.tool_radius_m = 0.0}).has_value());
  for (const Floor* floor : {&stiff, &damped}) {
    const auto loaded = controller->load_scene(floor->objects(), {.tool_radius_m = 0.0});
    ASSERT_FALSE(loaded.has_value());
    EXPECT_EQ(loaded.error().fault, SceneFault::uncertified);
  }
  ControllerConfig told = certified_config();
  told.allow_uncertified = true;
  ASSERT_TRUE(controller->configure(told));
  EXPECT_TRUE(controller->load_scene(stiff.objects(), {.tool_radius_m = 0.0}).has_value());
}

TEST(Certificate, CountsTheNeedleWithTheWholeOfItsShaft) {
  const auto controller = std::make_unique<Controller>();
  ASSERT_TRUE(controller->configure(certified_config()));
  std::array<rendering::Object, 2> layers;
  for (const std::uint8_t i : std::to_array<std::uint8_t>({0, 1})) {
    layers.at(i) = {
        .surface = rendering::SurfaceKind::primitive,
        .primitive = {.kind = rendering::PrimitiveKind::box, .dimensions_m = {0.1, 0.01, 0.1}},
        .tissue = i};
    layers.at(i).primitive.X_WO.translation.y() = -0.05 * i;
  }
  std::array<rendering::Tissue, 2> tissues;
  const auto loaded = [&] {
    return controller->load_scene(
        layers, {.needle = {.needle = {.length_m = 0.1, .tip_stiffness_N_per_m = 400.0},
                            .tissues = tissues}});
  };
  for (rendering::Tissue& tissue : tissues) {
    tissue.shaft_stiffness_N_per_m2 = 5000.0;
  }
  EXPECT_TRUE(loaded());  // 400 N/m of the tip and 500 N/m along 0.1 m, however many layers
  tissues[1].shaft_stiffness_N_per_m2 = 6100.0;
  ASSERT_FALSE(loaded());
  EXPECT_EQ(loaded().error().fault, SceneFault::uncertified);
  EXPECT_NEAR(loaded().error().part.stiffness_N_per_m, 1010.0, 1e-9);
  tissues[1].shaft_stiffness_N_per_m2 = 5000.0;
  // 100 d + 90000 d^2 = 1 N at 2.82 mm, where its slope is 608 N/m.
  tissues[0].stiffness_N_per_m = 100.0;
  tissues[0].stiffness_N_per_m2 = 90000.0;
  tissues[0].puncture_force_N = 1.0;
  ASSERT_FALSE(loaded());
  EXPECT_NEAR(loaded().error().part.stiffness_N_per_m, std::sqrt(1e4 + 4.0 * 90000.0) + 500.0,
              1e-6);
}

TEST(Certificate, DoesNotComeOverALoadedSceneThatIsStiffer) {
  const auto controller = std::make_unique<Controller>();
  ASSERT_TRUE(controller->configure(cartesian_config()));
  const Floor stiff({.stiffness_N_per_m = 1500.0});
  ASSERT_TRUE(controller->load_scene(stiff.objects(), {.tool_radius_m = 0.0}).has_value());
  const auto configured = controller->configure(certified_config());
  ASSERT_FALSE(configured);
  EXPECT_EQ(configured.error().field, "certificate");
}

}  // namespace
}  // namespace tactus::firmware
