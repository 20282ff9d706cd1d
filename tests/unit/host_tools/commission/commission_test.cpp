#include "host_tools/commission/commission.h"

#include <gtest/gtest.h>

#include "host_tools/commission/commission_report.h"
#include "host_tools/commission/simulated_bench.h"
#include "host_tools/simulation/device_presets.h"

namespace tactus::host {
namespace {

using firmware::Verdict;

class CommissionTest : public ::testing::TestWithParam<std::string_view> {
 protected:
  CommissionReport run(const WiringMistake& mistake = {}) {
    DevicePreset preset = *device_preset(GetParam());
    preset.device.plant.elbow_kg = 0.0;  // the arm is supported
    preset.device.plant.handle_kg = 0.0;
    firmware::ControllerConfig controller = *firmware::preset_config(GetParam());
    SimulatedBench bench(preset.device, controller.rate_hz, preset.centre_B, mistake);
    CommissionReport report =
        commission(bench, {.controller = controller,
                           .joints = {"first", "second", "third"},
                           .moving_mass_kg = preset.device.plant.moving_mass_kg});
    moved_m = bench.moved_m();
    return report;
  }

  std::size_t joints() const {
    return firmware::joint_count(firmware::preset_config(GetParam())->mechanism);
  }

  // Expects that only that joint fails, with that verdict.
  void expect_found(const CommissionReport& report, std::size_t joint, Verdict verdict) {
    EXPECT_FALSE(report.has_passed());
    EXPECT_EQ(firmware::text_of(report.joints[joint].verdict).name, firmware::text_of(verdict).name)
        << report_text(report);
  }

  double moved_m = 0.0;
};

TEST_P(CommissionTest, PassesADeviceThatIsAsItIsDescribed) {
  const CommissionReport report = run();
  EXPECT_TRUE(report.has_passed()) << report_text(report);
  for (const JointReport& joint : report.joints) {
    EXPECT_NEAR(joint.fit.inertia, joint.expected_inertia, 0.3 * joint.expected_inertia)
        << report_text(report);
    EXPECT_GE(joint.fit.delay_ticks, 1U);
    EXPECT_LE(joint.fit.delay_ticks, 3U);
  }
  EXPECT_LT(moved_m, 0.02);
}

TEST_P(CommissionTest, FindsEachReversedMotorAndEncoder) {
  for (std::size_t i = 0; i < joints(); ++i) {
    WiringMistake motor;
    motor.torque_scale[i] = -1.0;
    expect_found(run(motor), i, Verdict::reversed);
    EXPECT_LT(moved_m, 0.02);
    WiringMistake encoder;
    encoder.position_scale[i] = -1.0;
    EXPECT_FALSE(run(encoder).has_passed()) << i;
  }
}

TEST_P(CommissionTest, FindsAllMotorsReversed) {
  const CommissionReport report = run({.torque_scale = {-1.0, -1.0, -1.0}});
  for (std::size_t i = 0; i < joints(); ++i) {
    expect_found(report, i, Verdict::reversed);
  }
}

TEST_P(CommissionTest, FindsTorqueThreeTimesOrAThirdOfWhatIsSaid) {
  for (std::size_t i = 0; i < joints(); ++i) {
    WiringMistake strong;
    strong.torque_scale[i] = 3.0;
    expect_found(run(strong), i, Verdict::too_light);
    WiringMistake weak;
    weak.torque_scale[i] = 1.0 / 3.0;
    EXPECT_FALSE(run(weak).has_passed());
  }
}

TEST_P(CommissionTest, FindsAnEncoderScaleThatIsWrongByFour) {
  for (std::size_t i = 0; i < joints(); ++i) {
    for (const double scale : {0.25, 4.0}) {
      WiringMistake mistake;
      mistake.position_scale[i] = scale;
      EXPECT_FALSE(run(mistake).has_passed()) << scale << " of joint " << i;
    }
  }
}

TEST_P(CommissionTest, FindsExchangedMotors) {
  if (joints() < 2) {
    return;
  }
  EXPECT_FALSE(run({.motor_of = {1, 0, 2}}).has_passed());
}

TEST_P(CommissionTest, ComparesWhatTheDriveReports) {
  EXPECT_TRUE(run({.reports_torque = true}).has_passed());
  WiringMistake weak{.reports_torque = true};
  weak.torque_scale[0] = 0.6;  // within what the inertia may differ by
  expect_found(run(weak), 0, Verdict::torque_differs);
}

TEST_P(CommissionTest, DoesNotPassWhileSomebodyHoldsTheHandle) {
  EXPECT_FALSE(run({.holds_the_handle = true}).has_passed());
}

INSTANTIATE_TEST_SUITE_P(EveryPreset, CommissionTest, ::testing::ValuesIn(firmware::kPresetNames),
                         [](const auto& name) { return std::string(name.param); });

}  // namespace
}  // namespace tactus::host
