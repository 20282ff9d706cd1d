// The simulated device of a device file: its geometry against the controller's kinematics, which
// shares nothing with it, and its weights against the potential of its links.
#include "host_tools/simulation/described_device.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include "host_tools/bake/device/device_bake.h"
#include "host_tools/input_error.h"
#include "host_tools/simulation/described_mechanism.h"
#include "host_tools/simulation/device_workspace.h"
#include "host_tools/simulation/named_device.h"
#include "host_tools/simulation/random.h"
#include "host_tools/simulation/simulation.h"
#include "tests/support/folder_test.h"

namespace tactus::host {
namespace {

// Returns a path from the middle of the workspace to the right.
WishPath path_of(double right_m) {
  return WishPath({{.t_s = 0.0, .p_W = Vec3::Zero()}, {.t_s = 2.0, .p_W = {right_m, 0.0, 0.0}}});
}

// Returns a value between 0.6 and 1.6 times the usual one.
double other_than(double usual, SplitMix64& random) {
  return usual * random.uniform(0.6, 1.6);
}

firmware::LinkWeight any_weight(double length_m, SplitMix64& random) {
  return {.mass_kg = random.uniform(0.02, 0.3), .centre_m = length_m * random.uniform(-0.2, 0.9)};
}

// Returns a device of random lengths and weights, of the preset's kind and with its limits.
firmware::DeviceConfig random_device(std::string_view preset, SplitMix64& random) {
  firmware::DeviceConfig config;
  config.preset = preset;
  config.controller = *firmware::preset_config(preset);
  firmware::MechanismGeometry& geometry = config.controller.mechanism;
  config.joint_count = firmware::joint_count(geometry);
  if (auto* const axes = std::get_if<firmware::CartesianGeometry>(&geometry)) {
    axes->carried_kg = {random.uniform(0.1, 0.5), random.uniform(0.1, 0.5), random.uniform(0, 1)};
  } else if (auto* const delta = std::get_if<firmware::DeltaGeometry>(&geometry)) {
    const double share = other_than(1.0, random);
    for (double* const length_m :
         {&delta->arm_m, &delta->rod_m, &delta->base_radius_m, &delta->platform_radius_m,
          &delta->hinge_offset_m, &delta->base_tangent_m, &delta->platform_tangent_m}) {
      *length_m *= share * random.uniform(0.95, 1.05);
    }
    delta->nominal_height_m *= share;
    for (double& azimuth_rad : delta->azimuth_rad) {
      azimuth_rad += random.uniform(-0.05, 0.05);
    }
    delta->arm = any_weight(delta->arm_m, random);
    delta->rods_kg = random.uniform(0.01, 0.05);
    delta->platform_kg = random.uniform(0.05, 0.2);
  } else if (auto* const paddle = std::get_if<firmware::PaddleGeometry>(&geometry)) {
    paddle->handle_radius_m = other_than(paddle->handle_radius_m, random);
    paddle->paddle = any_weight(paddle->handle_radius_m, random);
  } else if (auto* const pantograph = std::get_if<firmware::PantographGeometry>(&geometry)) {
    const double share = other_than(1.0, random);
    pantograph->base_m *= share * random.uniform(0.9, 1.1);
    pantograph->proximal_m *= share * random.uniform(0.95, 1.05);
    pantograph->distal_m *= share * random.uniform(0.95, 1.05);
    pantograph->proximal = any_weight(pantograph->proximal_m, random);
    pantograph->distal = any_weight(pantograph->distal_m, random);
    pantograph->tool_kg = random.uniform(0.0, 0.1);
  } else if (auto* const arm = std::get_if<firmware::SerialArmGeometry>(&geometry)) {
    const double share = other_than(1.0, random);
    arm->upper_m *= share * random.uniform(0.9, 1.1);
    arm->forearm_m *= share * random.uniform(0.9, 1.1);
    arm->shoulder_height_m = random.uniform(0.0, 0.3);
    arm->upper = any_weight(arm->upper_m, random);
    arm->forearm = any_weight(arm->forearm_m, random);
    arm->tool_kg = random.uniform(0.0, 0.1);
  }
  return config;
}

class EveryDescribedDevice : public ::testing::TestWithParam<std::string_view> {
 protected:
  // Returns a place between the stops.
  Vec3 random_place(const DevicePreset& device) {
    const PlantParameters& plant = device.device.plant;
    Vec3 p_B;
    for (int axis = 0; axis < 3; ++axis) {
      p_B[axis] = plant.stop_lower_B[axis] +
                  random_.uniform(0.0, 1.0) * (plant.stop_upper_B[axis] - plant.stop_lower_B[axis]);
    }
    return on_manifold(plant.mechanism, p_B);
  }

  SplitMix64 random_{11};
};

TEST_P(EveryDescribedDevice, TheControllerSeesTheHandleWhereItIsAllOverTheWorkspace) {
  for (int geometry = 0; geometry < 40; ++geometry) {
    const firmware::DeviceConfig config = random_device(GetParam(), random_);
    const DevicePreset device = described_device(config);
    const PlantParameters& plant = device.device.plant;
    EXPECT_GT((plant.stop_upper_B - plant.stop_lower_B).norm(), 0.02);
    for (int i = 0; i < 100; ++i) {
      const Vec3 p_B = random_place(device);
      const auto seen = controller_pose(config.controller, plant.mechanism, p_B);
      ASSERT_TRUE(seen) << geometry << " at " << p_B.transpose();
      EXPECT_LT((seen->p_D - p_B).norm(), 1e-9) << geometry << " at " << p_B.transpose();
      // Rows and Jacobian are inverse to each other along what the handle moves on.
      MechanismPose pose;
      solve_mechanism(plant.mechanism, p_B, pose);
      for (std::size_t joint = 0; joint < config.joint_count; ++joint) {
        for (std::size_t other = 0; other < config.joint_count; ++other) {
          EXPECT_NEAR(pose.rows[joint].dot(seen->jacobian_D.col(static_cast<Eigen::Index>(other))),
                      joint == other ? 1.0 : 0.0, 1e-6);
        }
      }
    }
  }
}

TEST_P(EveryDescribedDevice, TheControllersGravityEffortHoldsItsWeights) {
  for (int geometry = 0; geometry < 40; ++geometry) {
    const firmware::DeviceConfig config = random_device(GetParam(), random_);
    const DevicePreset device = described_device(config);
    const PlantParameters& plant = device.device.plant;
    const Vec3 gravity_B(1.0, -9.0, 3.0);
    for (int i = 0; i < 50; ++i) {
      const Vec3 p_B = random_place(device);
      MechanismPose pose;
      solve_mechanism(plant.mechanism, p_B, pose);
      const Vec3 joints = joints_at(plant.mechanism, pose);
      const firmware::Mechanism mechanism(config.controller.mechanism);
      const Vec3 effort =
          mechanism.gravity_effort(joints, mechanism.forward(joints, p_B), gravity_B);
      Vec3 force_B = plant.handle_kg * gravity_B +
                     plant.elbow_kg * elbow_pull(plant.mechanism, pose, gravity_B);
      const double weight_N = force_B.norm();
      for (std::size_t joint = 0; joint < config.joint_count; ++joint) {
        force_B += effort[static_cast<Eigen::Index>(joint)] * pose.rows[joint];
      }
      EXPECT_LT(along_manifold(plant.mechanism, p_B, force_B).norm(), 1e-6 * (1.0 + weight_N))
          << geometry << " at " << p_B.transpose();
    }
  }
}

TEST_P(EveryDescribedDevice, RunsUnderTheControllerWithoutAFault) {
  const firmware::DeviceConfig config = random_device(GetParam(), random_);
  SimulationConfig run{
      .device = described_device(config), .controller = config.controller, .path = path_of(0.01)};
  run.controller.safety.moving_mass_kg = run.device.device.plant.moving_mass_kg;
  Simulation simulation(std::span(&run, 1), {}, 0.001);
  for (int tick = 0; tick < 2000; ++tick) {
    simulation.tick();
    ASSERT_EQ(simulation.record().faults, 0U) << tick;
  }
  EXPECT_EQ(simulation.controller().mode(), firmware::Mode::active);
}

INSTANTIATE_TEST_SUITE_P(Presets, EveryDescribedDevice, ::testing::ValuesIn(firmware::kPresetNames),
                         [](const auto& name) { return std::string(name.param); });

// Level upper arm, hanging forearm: the weight of the forearm and the tool hangs at the elbow's
// distance, and at a handle that moves along the vertical the whole arm turns.
TEST(DescribedArm, HangsByItsLeversInALevelPose) {
  firmware::DeviceConfig config;
  config.preset = "phantom_premium";
  config.controller = firmware::phantom_premium_config();
  config.joint_count = 3;
  config.controller.mechanism =
      firmware::SerialArmGeometry{.upper_m = 0.3,
                                  .forearm_m = 0.2,
                                  .shoulder_height_m = 0.1,
                                  .upper = {.mass_kg = 0.4, .centre_m = 0.15},
                                  .forearm = {.mass_kg = 0.2, .centre_m = 0.05},
                                  .tool_kg = 0.1};
  const PlantParameters plant = described_device(config).device.plant;
  MechanismPose pose;
  solve_mechanism(plant.mechanism, {0.0, 0.1 - 0.2, 0.3}, pose);
  const Vec3 pull_B = plant.handle_kg * Vec3(0.0, -10.0, 0.0) +
                      plant.elbow_kg * elbow_pull(plant.mechanism, pose, {0.0, -10.0, 0.0});
  // The moment about the shoulder is 10 (0.4 0.15 + (0.2 + 0.1) 0.3) N m, and the handle is 0.3 m
  // away.
  EXPECT_NEAR(pull_B.y(), -10.0 * (0.4 * 0.15 + 0.3 * 0.3) / 0.3, 1e-9);
  EXPECT_NEAR(pull_B.x(), 0.0, 1e-9);
  EXPECT_NEAR(pull_B.z(), 0.0, 1e-9);
}

TEST(DescribedArm, ReachesNothingIsAnErrorThatNamesTheKeys) {
  firmware::DeviceConfig config;
  config.preset = "woodenhaptics";
  config.controller = firmware::woodenhaptics_config();
  config.joint_count = 3;
  config.controller.mechanism = firmware::SerialArmGeometry{.upper_m = 0.01, .forearm_m = 0.9};
  for (firmware::JointLimits& joint : config.controller.joints) {
    joint.lower = 0.1;
    joint.upper = 0.11;
  }
  try {
    described_device(config);
    FAIL() << "it was simulated";
  } catch (const InputError& error) {
    EXPECT_TRUE(std::string(error.what()).contains("lower_rad")) << error.what();
  }
}

class DeviceFileOfAPreset : public FolderTest {
 protected:
  // Returns the chain over 1 s of ticks of a device on a path through its workspace.
  static std::uint64_t hash_of(const std::string& name) {
    const NamedDevice named = named_device(name, "--device");
    SimulationConfig run{
        .device = named.device, .controller = named.controller, .path = path_of(0.02)};
    run.controller.safety.moving_mass_kg = named.device.device.plant.moving_mass_kg;
    Simulation simulation(std::span(&run, 1), {}, 0.001);
    for (int tick = 0; tick < 1000; ++tick) {
      simulation.tick();
    }
    return simulation.record().state_hash;
  }
};

TEST_F(DeviceFileOfAPreset, IsSimulatedToTheBitAsThePresetIs) {
  const std::string own = file("own.toml");
  std::ofstream(own) << R"(
name = "A Falcon, written out"
[mechanism]
kind = "falcon"
arm_m = 0.060
rod_m = 0.1025
hinge_offset_m = 0.0225
base_radius_m = 0.0400
base_tangent_m = -0.02309
platform_radius_m = 0.01443
platform_tangent_m = -0.025
[[connection]]
name = "usb"
kind = "falcon_usb"
firmware_file = "nvent_firmware.bin"
unproven_watchdog = true
[[axis]]
name = "a"
driver = "falcon_usb"
connection = "usb"
number = 0
[[axis]]
name = "b"
driver = "falcon_usb"
connection = "usb"
number = 1
[[axis]]
name = "c"
driver = "falcon_usb"
connection = "usb"
number = 2
[[joint]]
name = "top"
motor = "a"
reference = "board"
[[joint]]
name = "right"
motor = "b"
reference = "board"
[[joint]]
name = "left"
motor = "c"
reference = "board"
)";
  EXPECT_EQ(hash_of(own), hash_of("falcon"));
  EXPECT_NE(hash_of(own), hash_of("cartesian"));
}

}  // namespace
}  // namespace tactus::host
