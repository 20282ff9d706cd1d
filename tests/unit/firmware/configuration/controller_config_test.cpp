#include "firmware/configuration/controller_config.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <numbers>

namespace tactus::firmware {
namespace {

TEST(ControllerConfig, ThePresetsAreValid) {
  EXPECT_TRUE(validate(ControllerConfig{}));
  for (const std::string_view name : kPresetNames) {
    const auto config = preset_config(name);
    ASSERT_TRUE(config) << name;
    EXPECT_TRUE(validate(*config)) << name;
    const Mechanism mechanism{config->mechanism};
    EXPECT_EQ(joint_count(config->mechanism), name == "hapkit"             ? 1U
                                              : name == "haply_pantograph" ? 2U
                                                                           : 3U);
  }
  EXPECT_FALSE(preset_config("omega"));
}

// The model of a joint whose friction is compensated.
rendering::FrictionParameters& compensated(ControllerConfig& config) {
  config.friction[0] = {.model = {.kind = rendering::FrictionKind::stribeck},
                        .compensated_share = 0.5,
                        .turn_length = 1e-4};
  return config.friction[0].model;
}

struct BadField {
  std::string_view field;
  std::function<void(ControllerConfig&, double)> set;
};

TEST(ControllerConfig, CompensationNeedsALengthToTurnRoundOver) {
  ControllerConfig config;
  config.friction[0] = {
      .model = {.kind = rendering::FrictionKind::coulomb_viscous, .coulomb = 0.04},
      .compensated_share = 0.5};
  const auto valid = validate(config);
  ASSERT_FALSE(valid);
  EXPECT_EQ(valid.error().field, "friction.turn_length");
  config.friction[0].turn_length = 20e-6;
  EXPECT_TRUE(validate(config));
  EXPECT_EQ(presliding_length(config.friction[0]), 20e-6);
  config.friction[0].model.stiffness_N_per_m = 1000.0;
  EXPECT_EQ(presliding_length(config.friction[0]), 40e-6);
}

TEST(ControllerConfig, CompensationIsOffAndLeavesRoomAtMost) {
  ControllerConfig config;
  EXPECT_EQ(config.friction[0].compensated_share, 0.0);
  compensated(config);
  config.friction[0].compensated_share = 0.91;
  const auto valid = validate(config);
  ASSERT_FALSE(valid);
  EXPECT_EQ(valid.error().field, "friction.compensated_share");
  EXPECT_EQ(valid.error().greatest, 0.9);
}

TEST(ControllerConfig, ABadFieldIsNamedWithItsValueAndRange) {
  const auto fields = std::to_array<BadField>({
      {"rate_hz", [](ControllerConfig& c, double v) { c.rate_hz = v; }},
      {"tick_instructions", [](ControllerConfig& c, double v) { c.tick_instructions = v; }},
      {"workspace_origin_D", [](ControllerConfig& c, double v) { c.workspace_origin_D.y() = v; }},
      {"velocity_cutoff_hz", [](ControllerConfig& c, double v) { c.velocity_cutoff_hz = v; }},
      {"joints.lower", [](ControllerConfig& c, double v) { c.joints[2].lower = v; }},
      {"joints.upper", [](ControllerConfig& c, double v) { c.joints[1].upper = v; }},
      {"joints.max_effort", [](ControllerConfig& c, double v) { c.joints[0].max_effort = v; }},
      {"safety.max_force_N", [](ControllerConfig& c, double v) { c.safety.max_force_N = v; }},
      {"safety.force_slew_N_per_s",
       [](ControllerConfig& c, double v) { c.safety.force_slew_N_per_s = v; }},
      {"safety.soft_start_s", [](ControllerConfig& c, double v) { c.safety.soft_start_s = v; }},
      {"safety.contact_start_s",
       [](ControllerConfig& c, double v) { c.safety.contact_start_s = v; }},
      {"friction.compensated_share",
       [](ControllerConfig& c, double v) { c.friction[1].compensated_share = v; }},
      {"friction.turn_length",
       [](ControllerConfig& c, double v) { c.friction[2].turn_length = v; }},
      {"friction.model.coulomb", [](ControllerConfig& c, double v) { compensated(c).coulomb = v; }},
      {"friction.model.static_level",
       [](ControllerConfig& c, double v) { compensated(c).static_level = v; }},
      {"friction.model.viscous_s_per_m",
       [](ControllerConfig& c, double v) { compensated(c).viscous_s_per_m = v; }},
      {"friction.model.stiffness_N_per_m",
       [](ControllerConfig& c, double v) { compensated(c).stiffness_N_per_m = v; }},
      {"mechanism.arm_m",
       [](ControllerConfig& c, double v) { c.mechanism = DeltaGeometry{.arm_m = v}; }},
      {"mechanism.rod_m",
       [](ControllerConfig& c, double v) { c.mechanism = DeltaGeometry{.rod_m = v}; }},
      {"mechanism.base_radius_m",
       [](ControllerConfig& c, double v) { c.mechanism = DeltaGeometry{.base_radius_m = v}; }},
      {"mechanism.platform_tangent_m",
       [](ControllerConfig& c, double v) { c.mechanism = DeltaGeometry{.platform_tangent_m = v}; }},
      {"mechanism.nominal_height_m",
       [](ControllerConfig& c, double v) { c.mechanism = DeltaGeometry{.nominal_height_m = v}; }},
      {"mechanism.rods_kg",
       [](ControllerConfig& c, double v) { c.mechanism = DeltaGeometry{.rods_kg = v}; }},
      {"mechanism.carried_kg",
       [](ControllerConfig& c, double v) { c.mechanism = CartesianGeometry{{0.0, v, 0.0}}; }},
      {"mechanism.handle_radius_m",
       [](ControllerConfig& c, double v) { c.mechanism = PaddleGeometry{.handle_radius_m = v}; }},
      {"mechanism.paddle.centre_m",
       [](ControllerConfig& c,
          double v) { c.mechanism = PaddleGeometry{.paddle = {.centre_m = v}}; }},
      {"mechanism.base_m",
       [](ControllerConfig& c, double v) { c.mechanism = PantographGeometry{.base_m = v}; }},
      {"mechanism.distal_m",
       [](ControllerConfig& c, double v) { c.mechanism = PantographGeometry{.distal_m = v}; }},
      {"mechanism.distal.mass_kg",
       [](ControllerConfig& c,
          double v) { c.mechanism = PantographGeometry{.distal = {.mass_kg = v}}; }},
      {"mechanism.upper_m",
       [](ControllerConfig& c, double v) { c.mechanism = SerialArmGeometry{.upper_m = v}; }},
      {"mechanism.shoulder_height_m",
       [](ControllerConfig& c,
          double v) { c.mechanism = SerialArmGeometry{.shoulder_height_m = v}; }},
      {"mechanism.forearm.mass_kg",
       [](ControllerConfig& c,
          double v) { c.mechanism = SerialArmGeometry{.forearm = {.mass_kg = v}}; }},
      {"mechanism.tool_kg",
       [](ControllerConfig& c, double v) { c.mechanism = SerialArmGeometry{.tool_kg = v}; }},
      {"gravity_D", [](ControllerConfig& c, double v) { c.gravity_D.z() = v; }},
      {"coupled_limits.lower",
       [](ControllerConfig& c, double v) { c.coupled_limits[1].lower = v; }},
      {"coupled_limits.upper",
       [](ControllerConfig& c, double v) { c.coupled_limits[0].upper = v; }},
  });
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const BadField& bad : fields) {
    for (const double value :
         {std::numeric_limits<double>::quiet_NaN(), kInfinity, -kInfinity, -1e9}) {
      ControllerConfig config;
      bad.set(config, value);
      const auto valid = validate(config);
      ASSERT_FALSE(valid) << bad.field << " = " << value;
      EXPECT_EQ(valid.error().field, bad.field);
      EXPECT_TRUE(valid.error().value == value || std::isnan(value));
      EXPECT_LE(valid.error().least, valid.error().greatest);
    }
  }
}

TEST(ControllerConfig, ATicksInstructionsFollowFromTheRateUnlessGiven) {
  ControllerConfig config{.rate_hz = 2000.0};
  EXPECT_DOUBLE_EQ(tick_instructions(config), 1e6);
  config.tick_instructions = 300e3;
  EXPECT_TRUE(validate(config));
  EXPECT_EQ(tick_instructions(config), 300e3);
  config.tick_instructions = 1000.0;
  EXPECT_EQ(validate(config).error().field, "tick_instructions");
}

TEST(ControllerConfig, StaleTicksAndSampleAgeHaveARange) {
  ControllerConfig config;
  config.safety.stale_ticks_to_fault = 0;
  EXPECT_EQ(validate(config).error().field, "safety.stale_ticks_to_fault");
  config = {};
  config.safety.max_sample_age_us = 1'000'001;
  EXPECT_EQ(validate(config).error().field, "safety.max_sample_age_us");
}

TEST(ControllerConfig, ACoupledLimitIsBetweenJointsThatThereAre) {
  ControllerConfig config;
  config.coupled_limits[0].joint = kJointCount;
  EXPECT_EQ(validate(config).error().field, "coupled_limits.joint");
  config.coupled_limits[0] = {.minus = kJointCount};
  EXPECT_EQ(validate(config).error().field, "coupled_limits.minus");
}

// Published: 1.8, 1.5 and 1.9 N for good at the PHANToM's zero pose, 4.5 times that at stall.
TEST(ControllerConfig, ThePhantomsEffortsAreThePublishedForcesAtItsZeroPose) {
  const ControllerConfig config = phantom_premium_config();
  const Pose pose = Mechanism{config.mechanism}.forward(Vec3::Zero(), Vec3::Zero());
  EXPECT_EQ(pose.p_D, config.workspace_origin_D);
  const Vec3 levers = pose.jacobian_D.colwise().norm();
  EXPECT_NEAR(config.joints[0].max_effort / levers[0], 1.8, 0.05);
  EXPECT_NEAR(config.joints[1].max_effort / levers[1], 1.5, 0.05);
  EXPECT_NEAR(config.joints[2].max_effort / levers[2], 1.9, 0.05);
}

TEST(ControllerConfig, TheHapkitsMotorReachesTheForceThatItIsAllowed) {
  const ControllerConfig config = hapkit_config();
  const double most_N = config.joints[0].max_effort / PaddleGeometry{}.handle_radius_m;
  EXPECT_NEAR(most_N, 7.975, 5e-4);
  EXPECT_LE(config.safety.max_force_N, most_N);
}

TEST(ControllerConfig, TheFalconMayPushItsRatedForceNearItsMiddle) {
  const ControllerConfig config = falcon_config();
  EXPECT_EQ(config.safety.max_force_N, 8.0);
  const Delta delta(std::get<DeltaGeometry>(config.mechanism));
  for (double x = -0.04; x <= 0.04; x += 0.01) {
    for (double y = -0.04; y <= 0.04; y += 0.01) {
      for (double z = -0.04; z <= 0.04; z += 0.01) {
        const Vec3 offset(x, y, z);
        if (offset.norm() > 0.04) {
          continue;
        }
        const Vec3 tool = config.workspace_origin_D + offset;
        const Pose pose = delta.forward(*delta.inverse(tool), tool);
        EXPECT_LE(8.0 * pose.jacobian_D.colwise().norm().maxCoeff(), config.joints[0].max_effort);
        EXPECT_GE(delta.inverse(tool)->minCoeff(), config.joints[0].lower);
        EXPECT_LE(delta.inverse(tool)->maxCoeff(), config.joints[0].upper);
      }
    }
  }
}

}  // namespace
}  // namespace tactus::firmware
