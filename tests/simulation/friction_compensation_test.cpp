// Friction compensation on the simulated device: quantised encoders, a tick of delay, motors that
// lag.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <numbers>

#include "firmware/control/controller.h"
#include "firmware/control/run_tick.h"
#include "host_tools/simulation/device_presets.h"
#include "host_tools/simulation/hand.h"
#include "host_tools/simulation/random.h"
#include "host_tools/simulation/simulated_device.h"
#include "tests/support/rows.h"
#include "tests/support/without_sign_check.h"

namespace tactus::testing {
namespace {

using host::HandParameters;

constexpr double kTick_s = 1e-3;
constexpr HandParameters kLetGo{};
constexpr HandParameters kGrip{
    .mass_kg = 0.05, .damping_Ns_per_m = 5.0, .stiffness_N_per_m = 1000.0, .tremor_m = 0.0};

struct Rig {
  host::DevicePreset device;
  firmware::ControllerConfig controller;
};

// The device's own friction, as if a fit had found it exactly; the viscous damping at the handle is
// left out, since it is not the joints'.
Rig rig(host::DevicePreset device, firmware::ControllerConfig controller, double viscous,
        double share) {
  device.device.plant.viscous_Ns_per_m = 0.0;
  device.device.plant.joint_friction.viscous_s_per_m = viscous;
  controller.workspace_origin_D = device.centre_B;
  controller.safety.soft_start_s = 0.1;
  controller.friction.fill({.model = device.device.plant.joint_friction,
                            .compensated_share = share,
                            .turn_length = 2.0 * device.device.encoder_resolution});
  return {device, controller};
}

Rig cartesian(double share) {
  return rig(host::cartesian_preset(), without_sign_check(firmware::cartesian_config()), 0.5,
             share);
}
Rig falcon(double share) {
  return rig(host::falcon_preset(), without_sign_check(firmware::falcon_config()), 0.001, share);
}

// Less than the model says: 20 percent.
Rig overestimated(Rig rig) {
  rendering::FrictionParameters& friction = rig.device.device.plant.joint_friction;
  friction = scaled(friction, 0.8);
  friction.stiffness_N_per_m *= 0.8;
  return rig;
}

// Controller, device and a hand that can let go, with nothing to touch: the motors give out what
// the compensation gives out, and no more.
class Loop {
 public:
  explicit Loop(const Rig& rig)
      : centre_B_(rig.device.centre_B),
        device_(rig.device.device, kTick_s, rig.device.centre_B),
        controller_(std::make_unique<firmware::Controller>()) {
    EXPECT_TRUE(controller_->configure(rig.controller));
    for (int i = 0; i < 500; ++i) {
      tick(kGrip, Vec3::Zero());
    }
    EXPECT_EQ(controller_->mode(), firmware::Mode::active);
  }

  // One tick in which the hand's wish goes to `wish`, from the middle of the workspace.
  void tick(const HandParameters& hand, const Vec3& wish) {
    firmware::run_tick(*controller_, device_, firmware::request_toward_active(controller_->mode()));
    EXPECT_EQ(controller_->record().faults, 0U);
    device_.advance(hand, centre_B_ + wish_, centre_B_ + wish);
    wish_ = wish;
  }

  [[nodiscard]] const host::Plant& plant() const { return device_.plant(); }
  [[nodiscard]] Vec3 place() const { return device_.plant().p_B() - centre_B_; }
  // Return the energy that the compensation has given out, and that the joints' friction has taken,
  // J.
  [[nodiscard]] double given_J() const { return plant().ledger().motors_J; }
  [[nodiscard]] double taken_J() const { return -plant().ledger().friction_and_stops_J; }
  [[nodiscard]] const firmware::TelemetryRecord& record() const { return controller_->record(); }

 private:
  Vec3 centre_B_;
  host::SimulatedDevice device_;
  std::unique_ptr<firmware::Controller> controller_;
  Vec3 wish_ = Vec3::Zero();
};

// Returns the place of a hand that moves to and fro along x by 20 mm in 2 s.
Vec3 slow_stroke(int tick) {
  return {0.02 * std::sin(std::numbers::pi * kTick_s * tick), 0.0, 0.0};
}

// The hand's work in a cycle, once that is steady, J.
double drag_J(const Rig& rig) {
  Loop loop(rig);
  constexpr int kCycle = 2000;
  double before_J = 0.0;
  for (int tick = 0; tick < 4 * kCycle; ++tick) {
    if (tick == 2 * kCycle) {
      before_J = loop.plant().ledger().hand_J;
    }
    loop.tick(kGrip, slow_stroke(tick));
  }
  return (loop.plant().ledger().hand_J - before_J) / 2.0;
}

TEST(FrictionCompensation, TheFeltDragFallsByTheShare) {
  const double cartesian_J = drag_J(cartesian(0.0));
  const double falcon_J = drag_J(falcon(0.0));
  // Four amplitudes of Coulomb friction, and the viscous work.
  EXPECT_NEAR(cartesian_J, 4.0 * 0.02 * 0.04, 0.5 * cartesian_J);
  for (const double share : {0.3, 0.6, 0.9}) {
    EXPECT_NEAR(drag_J(cartesian(share)), (1.0 - share) * cartesian_J, 0.03 * cartesian_J) << share;
    EXPECT_NEAR(drag_J(falcon(share)), (1.0 - share) * falcon_J, 0.03 * falcon_J) << share;
  }
}

// A hand moves it and lets go in the midst of the motion. The handle has its viscous damping,
// without which a device that is nearly free of friction would coast into its stops. It rings out
// on the friction's bristles, the Falcon within 8 s.
void expect_rest(Rig rig, std::uint64_t seed) {
  constexpr double kSpeed_m_per_s = 0.04;
  constexpr double kReach_m = 0.008;
  SCOPED_TRACE("seed " + std::to_string(seed));
  rig.device.device.plant.viscous_Ns_per_m = 0.5;
  Loop loop(overestimated(rig));
  host::SplitMix64 random(seed);
  for (int round = 0; round < 4; ++round) {
    const Vec3 to{random.uniform(-kReach_m, kReach_m), random.uniform(-kReach_m, kReach_m),
                  random.uniform(-kReach_m, kReach_m)};
    const Vec3 from = loop.place();
    const int ticks = 1 + static_cast<int>((to - from).norm() / (kSpeed_m_per_s * kTick_s));
    for (int tick = 1; tick <= ticks; ++tick) {
      loop.tick(kGrip, from + (to - from) * tick / ticks);
    }
    for (int tick = 0; tick < 8000; ++tick) {
      loop.tick(kLetGo, loop.place());
    }
    const Vec3 there = loop.place();
    for (int tick = 0; tick < 3000; ++tick) {
      loop.tick(kLetGo, loop.place());
    }
    EXPECT_LT((loop.place() - there).norm(), 2e-6) << "round " << round;
    EXPECT_LT(loop.plant().v_B().norm(), 1e-6) << "round " << round;
  }
}

TEST(FrictionCompensation, ADeviceThatIsLetGoComesToRestAndStaysThereThoughTheModelIsTooLarge) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    for (const Rig& rig : {cartesian(0.75), falcon(0.75)}) {
      if (is_taken()) {
        expect_rest(rig, seed);
      }
    }
  }
}

TEST(FrictionCompensation, ADeviceAtRestDoesNotStartByItself) {
  for (const Rig& rig : {cartesian(0.9), falcon(0.9)}) {
    Loop loop(overestimated(rig));
    const Vec3 start = loop.place();
    for (int tick = 0; tick < 5000; ++tick) {
      loop.tick(kLetGo, loop.place());
    }
    EXPECT_LT((loop.place() - start).norm(), 1e-6);
  }
}

// Sums of three sines on each axis, of 2 um to `most_m` and 0.2 to 30 Hz.
class Wander {
 public:
  Wander(std::uint64_t seed, double most_m) {
    host::SplitMix64 random(seed);
    for (Wave& wave : waves_) {
      wave.hz = 0.2 * std::pow(150.0, random.uniform(0.0, 1.0));
      const double widest_m = std::min(most_m, 0.1 / wave.hz) / 3.0;
      wave.amplitude_m = kLeast_m * std::pow(widest_m / kLeast_m, random.uniform(0.0, 1.0));
      wave.phase = random.uniform(0.0, 2.0 * std::numbers::pi);
    }
  }
  [[nodiscard]] Vec3 at(int tick) const {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < waves_.size(); ++i) {
      const Wave& wave = waves_[i];
      const double angle = 2.0 * std::numbers::pi * wave.hz * kTick_s * tick;
      sum[static_cast<Eigen::Index>(i % 3)] +=
          wave.amplitude_m * (std::sin(angle + wave.phase) - std::sin(wave.phase));
    }
    return sum;
  }

 private:
  static constexpr double kLeast_m = 2e-6;
  struct Wave {
    double hz = 1.0;
    double amplitude_m = 0.0;
    double phase = 0.0;
  };
  std::array<Wave, 9> waves_;
};

constexpr double kStrokes_m = 0.02;
constexpr double kTrembling_m = 5e-5;  // one to ten counts, within the presliding

// Returns the most by which the energy given out by the compensation exceeded the energy taken by
// friction until then, J.
double overdraft_J(const Rig& rig, std::uint64_t seed, double most_m) {
  Loop loop(rig);
  const Wander wander(seed, most_m);
  const double start_J = loop.given_J() - loop.taken_J();
  double worst_J = 0.0;
  for (int tick = 0; tick < 8000; ++tick) {
    loop.tick(kGrip, wander.at(tick));
    worst_J = std::max(worst_J, loop.given_J() - loop.taken_J() - start_J);
  }
  return worst_J;
}

// Microjoules; the strokes take millijoules.
double held_by_bristles_J(const Rig& rig) {
  const rendering::FrictionParameters& friction = rig.device.device.plant.joint_friction;
  return 3.0 * friction.static_level * friction.static_level / (2.0 * friction.stiffness_N_per_m);
}

TEST(FrictionCompensation, GivesOutNoMoreThanTheFrictionTakesThoughTheModelIsTooLarge) {
  for (const Rig& rig : {overestimated(cartesian(0.75)), overestimated(falcon(0.75))}) {
    for (const double most_m : {kStrokes_m, kTrembling_m}) {
      for (std::uint64_t seed = 100; seed < 112; ++seed) {
        if (is_taken()) {
          EXPECT_LT(overdraft_J(rig, seed, most_m), held_by_bristles_J(rig))
              << "seed " << seed << ", up to " << most_m << " m";
        }
      }
    }
  }
}

// The other way round: why the push must not turn round sooner than the friction does.
TEST(FrictionCompensation, WouldGiveOutMoreIfItTurnedRoundTooSoon) {
  Rig rig = overestimated(cartesian(0.75));
  for (firmware::JointFriction& joint : rig.controller.friction) {
    joint.model.stiffness_N_per_m *= 100.0;
    joint.turn_length = 0.0;
  }
  EXPECT_GT(overdraft_J(rig, 100, kTrembling_m), 20.0 * held_by_bristles_J(rig));
}

}  // namespace
}  // namespace tactus::testing
