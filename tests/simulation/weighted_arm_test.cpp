// An arm with its own weight and nobody's hand on it: it floats while the controller holds it up,
// and sinks when it does not.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>

#include "firmware/control/controller.h"
#include "firmware/control/run_tick.h"
#include "host_tools/simulation/device_presets.h"
#include "host_tools/simulation/simulated_device.h"

namespace tactus::testing {
namespace {

constexpr double kArmTick_s = 1e-3;
constexpr host::HandParameters kHandsOff{};
constexpr host::HandParameters kSteadyHand{
    .mass_kg = 0.1, .damping_Ns_per_m = 10.0, .stiffness_N_per_m = 1000.0, .tremor_m = 0.0};

// A hand carries the arm to a place until the controller is active and its soft start over.
class CarriedArm {
 public:
  CarriedArm(const host::DevicePreset& preset, firmware::ControllerConfig config, const Vec3& from)
      : place_B_(preset.centre_B + from),
        device_(preset.device, kArmTick_s, place_B_),
        controller_(std::make_unique<firmware::Controller>()) {
    config.workspace_origin_D = preset.centre_B;
    EXPECT_TRUE(controller_->configure(config));
    run(kSteadyHand, 2.0);
    EXPECT_EQ(controller_->mode(), firmware::Mode::active);
    place_B_ = device_.plant().p_B();
  }

  // Lets go of the arm for that long and returns how far it has moved, m.
  Vec3 let_go(double seconds) {
    run(kHandsOff, seconds);
    return device_.plant().p_B() - place_B_;
  }

  [[nodiscard]] const firmware::TelemetryRecord& record() const { return controller_->record(); }

 private:
  void run(const host::HandParameters& hand, double seconds) {
    for (int tick = 0; tick < static_cast<int>(seconds / kArmTick_s); ++tick) {
      firmware::run_tick(*controller_, device_,
                         firmware::request_toward_active(controller_->mode()));
      device_.advance(hand, place_B_, place_B_);
      EXPECT_EQ(controller_->record().faults, 0U);
    }
  }

  Vec3 place_B_;
  host::SimulatedDevice device_;
  std::unique_ptr<firmware::Controller> controller_;
};

// Returns a device without friction: nothing but the motors can hold it.
host::DevicePreset slippery() {
  host::DevicePreset preset = host::woodenhaptics_preset();
  preset.device.plant.joint_friction = {};
  return preset;
}

firmware::ControllerConfig without_weights() {
  firmware::ControllerConfig config = firmware::woodenhaptics_config();
  auto& arm = std::get<firmware::SerialArmGeometry>(config.mechanism);
  arm.upper = {};
  arm.forearm = {};
  return config;
}

const std::array<Vec3, 4> kPlaces = {Vec3(0.0, 0.0, 0.0), Vec3(0.05, 0.04, 0.03),
                                     Vec3(-0.06, -0.02, 0.05), Vec3(0.02, 0.06, -0.05)};

TEST(WeightedArm, FloatsWithoutAHandAndWithoutFrictionWhenItIsCompensated) {
  for (const Vec3& from : kPlaces) {
    CarriedArm arm(slippery(), firmware::woodenhaptics_config(), from);
    EXPECT_GT(std::hypot(arm.record().joint_gravity[1], arm.record().joint_gravity[2]), 0.05);
    EXPECT_EQ(arm.record().joint_effort, arm.record().joint_gravity) << "it touches nothing";
    // Half an encoder's count of the wrong weight drives it: 0.1 mN or so.
    EXPECT_LT(arm.let_go(5.0).norm(), 0.002) << from.transpose();
  }
}

TEST(WeightedArm, SinksToItsStopWhenItIsNot) {
  for (const Vec3& from : kPlaces) {
    CarriedArm arm(slippery(), without_weights(), from);
    EXPECT_EQ(arm.record().joint_effort, firmware::TelemetryRecord{}.joint_effort);
    EXPECT_LT(arm.let_go(2.0).y(), -0.03) << from.transpose();
  }
}

// The preset as it is: friction of 0.1 N at the handle against a weight of 1.2 N.
TEST(WeightedArm, StaysWithFrictionWhenCompensatedAndSinksWhenNot) {
  for (const Vec3& from : kPlaces) {
    CarriedArm held(host::woodenhaptics_preset(), firmware::woodenhaptics_config(), from);
    EXPECT_LT(held.let_go(3.0).norm(), 2e-4) << from.transpose();
    CarriedArm loose(host::woodenhaptics_preset(), without_weights(), from);
    EXPECT_LT(loose.let_go(3.0).y(), -0.03) << from.transpose();
  }
}

}  // namespace
}  // namespace tactus::testing
