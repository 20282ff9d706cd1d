#include "firmware/safety/motor_sign_check.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>

#include "firmware/safety/faults.h"
#include "tests/support/share.h"

namespace tactus::firmware {
namespace {

// One sliding joint in a hand: a mass on the hand's spring and damper, whose wish moves.
struct Slide {
  double sign = 1.0;  // of the motor
  double mass_kg = 0.3;
  double spring_N_per_m = 800.0;
  double damper_Ns_per_m = 6.0;
  double count_m = 30e-6;
  std::size_t delay_ticks = 0;

  double position_m = 0.0;
  double speed_m_per_s = 0.0;
  std::array<double, 16> efforts{};
  std::size_t tick = 0;

  [[nodiscard]] double counted() const { return std::round(position_m / count_m) * count_m; }

  void move(double effort_N, double wish_m, double step_s) {
    efforts[tick % efforts.size()] = effort_N;
    const double acting = tick < delay_ticks ? 0.0 : efforts[(tick - delay_ticks) % efforts.size()];
    ++tick;
    constexpr int kSteps = 20;
    for (int i = 0; i < kSteps; ++i) {
      const double hand_N =
          spring_N_per_m * (wish_m - position_m) - damper_Ns_per_m * speed_m_per_s;
      speed_m_per_s += (sign * acting + hand_N) / mass_kg * step_s / kSteps;
      position_m += speed_m_per_s * step_s / kSteps;
    }
  }
};

// Three such joints, asked together.
class Asked {
 public:
  // `delay_ticks` is the device's, and known; the motors have it too.
  explicit Asked(double rate_hz, std::size_t delay_ticks = 0, double moving_mass_kg = 0.0)
      : step_s_(1.0 / rate_hz) {
    ControllerConfig config = cartesian_config();
    config.rate_hz = rate_hz;
    config.safety.device_delay_s = (static_cast<double>(delay_ticks) + 0.5) / rate_hz;
    for (Slide& joint : joints) {
      joint.delay_ticks = delay_ticks;
    }
    config.safety.moving_mass_kg = moving_mass_kg;
    check_.configure(config);
    check_.restart();
    pose.jacobian_D.setIdentity();
  }

  // Runs until a fault, the answer of all joints, or the end. The wish may depend on time and
  // joint.
  template <class Wish>
  EffortFinding run(double seconds, const Wish& wish_m) {
    for (double t_s = 0.0; t_s < seconds && !check_.is_done(); t_s += step_s_) {
      drivers::JointSample sample;
      for (std::size_t i = 0; i < 3; ++i) {
        sample.position[i] = joints[i].counted();
      }
      const EffortFinding found = check_.step(sample, pose, held_);
      held_ = check_.push();
      for (std::size_t i = 0; i < 3; ++i) {
        largest_N_ = std::max(largest_N_, std::abs(held_[i]));
        joints[i].move(held_[i], wish_m(i, t_s), step_s_);
      }
      time_s_ = t_s;
      if (found.faults != kNoFault) {
        return found;
      }
    }
    return {};
  }

  [[nodiscard]] const MotorSignCheck& check() const { return check_; }
  [[nodiscard]] double largest_N() const { return largest_N_; }
  [[nodiscard]] double time_s() const { return time_s_; }

  std::array<Slide, 3> joints{};
  Pose pose;

 private:
  double step_s_;
  MotorSignCheck check_;
  JointEfforts held_{};
  double largest_N_ = 0.0;
  double time_s_ = 0.0;
};

// A stroke of 0.2 m/s and a tremor of 0.1 mm at 10 Hz.
double strokes(std::size_t joint, double t_s) {
  return 0.2 * t_s + 1e-4 * std::sin(2.0 * std::numbers::pi * 10.0 * t_s + double(joint));
}

TEST(MotorSignCheck, RightMotorsAnswerAtEveryRateAndDelay) {
  for (const double rate_hz : {200.0, 1000.0, 1500.0, 4000.0, 10'000.0}) {
    for (const std::size_t delay : {0U, 1U, 3U}) {
      Asked asked(rate_hz, delay);
      EXPECT_EQ(asked.run(3.0, strokes).faults, kNoFault) << rate_hz << ' ' << delay;
      EXPECT_TRUE(asked.check().is_done()) << rate_hz << ' ' << delay;
      EXPECT_LE(asked.largest_N(), 1.0);
    }
  }
}

TEST(MotorSignCheck, AReversedMotorIsNamedAtEveryRateAndDelay) {
  for (const double rate_hz : {200.0, 1000.0, 1500.0, 4000.0, 10'000.0}) {
    for (const std::size_t delay : {0U, 1U, 3U}) {
      for (std::uint32_t wrong = 0; wrong < 3; ++wrong) {
        Asked asked(rate_hz, delay);
        asked.joints[wrong].sign = -1.0;
        const EffortFinding found = asked.run(3.0, strokes);
        EXPECT_EQ(found.faults, kFaultMotorReversed) << rate_hz << ' ' << delay;
        EXPECT_EQ(found.joint, wrong + 1U) << rate_hz << ' ' << delay;
      }
    }
  }
}

// 1.5 ms are said, a tick and the half for which it is held.
TEST(MotorSignCheck, ADelayThatIsOffByATickChangesNoAnswer) {
  for (const double sign : {1.0, -1.0}) {
    for (const std::size_t delay : {0U, 1U, 2U}) {
      Asked asked(1000.0);
      for (Slide& joint : asked.joints) {
        joint.delay_ticks = delay;
        joint.sign = sign;
      }
      EXPECT_EQ(asked.run(3.0, strokes).faults, sign > 0.0 ? kNoFault : kFaultMotorReversed)
          << delay;
      EXPECT_EQ(asked.check().is_done(), sign > 0.0) << delay;
    }
  }
}

// Until it moves, nothing is known of it, and the force stays small.
TEST(MotorSignCheck, AJointThatIsHeldFastIsNeitherRightNorReversed) {
  Asked asked(1000.0);
  asked.joints[1].mass_kg = 1e6;
  EXPECT_EQ(asked.run(20.0, [](std::size_t, double) { return 0.0; }).faults, kNoFault);
  EXPECT_FALSE(asked.check().is_done());
  EXPECT_LE(asked.largest_N() + asked.check().force_limit_N(), kUncheckedForce_N);
}

// In a pose in which a joint does not move the tool, it cannot be asked. The others answer
// meanwhile, so that it does not matter that they turn afterwards.
TEST(MotorSignCheck, AJointWithoutALeverTakesNoTurnFromTheOthers) {
  const auto still = [](std::size_t, double) { return 0.0; };
  Asked asked(1000.0);
  asked.pose.jacobian_D.col(0).setZero();
  EXPECT_EQ(asked.run(3.0, still).faults, kNoFault);
  EXPECT_FALSE(asked.check().is_done());
  asked.pose.jacobian_D.setIdentity();
  asked.joints[1].sign = -1.0;
  asked.joints[2].sign = -1.0;
  EXPECT_EQ(asked.run(3.0, still).faults, kNoFault);
  EXPECT_TRUE(asked.check().is_done());
}

// A motor without power: all that moves the joint is the hand, which shakes up to twice as fast as
// any hand can.
TEST(MotorSignCheck, AShakingHandIsNoAnswer) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const int hands = std::max(20, testing::share_of(400));
  for (int hand = 0; hand < hands; ++hand) {
    Asked asked(1000.0);
    std::array<double, 3> hz{};
    std::array<double, 3> phase{};
    for (std::size_t i = 0; i < 3; ++i) {
      asked.joints[i].sign = 0.0;
      hz[i] = 2.0 + 23.0 * unit(random);
      phase[i] = 6.3 * unit(random);
    }
    const EffortFinding found = asked.run(5.0, [&](std::size_t i, double t_s) {
      return 0.002 * std::sin(2.0 * std::numbers::pi * hz[i] * t_s + phase[i]);
    });
    EXPECT_EQ(found.faults, kNoFault) << hz[0] << ' ' << hz[1] << ' ' << hz[2];
    EXPECT_FALSE(asked.check().is_done()) << hz[0] << ' ' << hz[1] << ' ' << hz[2];
  }
}

TEST(MotorSignCheck, AJointThatAnswersMoreStronglyThanItsMassAllowsIsNamed) {
  const auto still = [](std::size_t, double) { return 0.0; };
  for (const double strength : {0.3, 1.0, 1.6, 3.0}) {
    Asked asked(1000.0, 0, 0.3);
    asked.joints[2].sign = strength;
    const EffortFinding found = asked.run(3.0, still);
    EXPECT_EQ(found.faults, strength > 2.0 ? kFaultEffortMismatch : kNoFault) << strength;
    EXPECT_EQ(found.joint, strength > 2.0 ? 3U : 0U) << strength;
  }
}

TEST(MotorSignCheck, AsksNobodyWhereThereIsNoPush) {
  ControllerConfig config = cartesian_config();
  config.safety.sign_check_N = 0.0;
  MotorSignCheck check;
  check.configure(config);
  check.restart();
  EXPECT_TRUE(check.is_done());
}

}  // namespace
}  // namespace tactus::firmware
