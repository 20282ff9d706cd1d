#include "host_tools/commission/commission.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "firmware/kinematics/mobility.h"
#include "firmware/safety/sample_check.h"
#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

using firmware::ControllerConfig;
using firmware::Verdict;

// Shares of a joint's range: a pulse grows until it moves the joint by the first, and is cut off at
// the second.
constexpr double kWantedTravel = 0.004;
constexpr double kLargestTravel = 0.06;

// Takes the motors' power away at the end of its scope, however that ends.
class PowerOff {
 public:
  explicit PowerOff(Bench& bench) : bench_(&bench) {}
  PowerOff(const PowerOff&) = delete;
  PowerOff& operator=(const PowerOff&) = delete;
  ~PowerOff() { bench_->write({}); }

 private:
  Bench* bench_;
};

// Returns the joint's range by device.toml, rad or m.
double range_of(const ControllerConfig& config, std::size_t joint) {
  return config.joints[joint].upper - config.joints[joint].lower;
}

// One run of the check, step by step.
class Session {
 public:
  Session(Bench& bench, const CommissionPlan& plan, const CommissionProgress& progress)
      : bench_(&bench),
        plan_(&plan),
        progress_(&progress),
        joints_(firmware::joint_count(plan.controller.mechanism)) {}

  // Does all steps. A trouble of the device ends the run early and is in the report.
  CommissionReport run() {
    const PowerOff at_the_end(*bench_);
    home();
    report_.moving_mass_kg = plan_->moving_mass_kg;
    report_.joints.resize(joints_);
    for (std::size_t i = 0; i < joints_; ++i) {
      report_.joints[i] = {.name = plan_->joints[i],
                           .lower = plan_->controller.joints[i].lower,
                           .upper = plan_->controller.joints[i].upper,
                           .slides = firmware::slides(plan_->controller.mechanism)};
    }
    watch_travel();
    let_person(HandTask::let_go);
    for (std::size_t i = 0; i < joints_ && report_.trouble.empty(); ++i) {
      try_joint(i);
    }
    return report_;
  }

 private:
  // Reports a step to the person, if someone listens.
  void tell(const std::string& step) {
    if (*progress_) {
      (*progress_)(step);
    }
  }

  // Writes a command, waits for the next tick and reads the sample.
  void tick(const drivers::JointCommand& command) {
    bench_->write(command);
    bench_->wait();
    bench_->read(sample_);
  }

  // Waits for the person. The loop goes on meanwhile, since a drive's watchdog would stop it
  // otherwise.
  void let_person(HandTask task) {
    bench_->ask(task);
    while (bench_->is_at_work(task)) {
      tick({});
    }
  }

  // Waits until the device has its reference. Throws InputError if that takes too long or fails.
  void home() {
    tell("homing");
    bench_->read(sample_);
    let_person(HandTask::hold_for_homing);
    const double limit = plan_->homing_limit_s * plan_->controller.rate_hz;
    for (double ticks = 0.0; !firmware::is_referenced(sample_.status); ++ticks) {
      if (ticks > limit || firmware::device_faults(sample_.status) != 0) {
        const std::string trouble = bench_->trouble();
        throw InputError(
            trouble.empty()
                ? fmt::format("the joints were not homed in {:.0f} s; see how each finds its "
                              "reference in device.toml",
                              plan_->homing_limit_s)
                : trouble);
      }
      tick({.home = true});
    }
  }

  // Notes how far each joint goes while the person moves the handle.
  void watch_travel() {
    tell("travel: the hand moves the handle everywhere");
    bench_->ask(HandTask::move_everywhere);
    for (std::size_t i = 0; i < joints_; ++i) {
      report_.joints[i].travel = {sample_.position[i], sample_.position[i]};
    }
    while (bench_->is_at_work(HandTask::move_everywhere)) {
      tick({});
      if (!firmware::is_referenced(sample_.status)) {
        report_.trouble = bench_->trouble();
        return;
      }
      for (std::size_t i = 0; i < joints_; ++i) {
        firmware::TravelSeen& seen = report_.joints[i].travel;
        seen.lower = std::min(seen.lower, sample_.position[i]);
        seen.upper = std::max(seen.upper, sample_.position[i]);
      }
    }
  }

  // Returns what the joint's trial should show according to device.toml.
  firmware::JointExpectation expected(std::size_t joint) const {
    firmware::JointExpectation expected{.inertia = report_.joints[joint].expected_inertia,
                                        .lower = report_.joints[joint].lower,
                                        .upper = report_.joints[joint].upper};
    for (std::size_t i = 0; i < joints_; ++i) {
      expected.range[i] = range_of(plan_->controller, i);
    }
    return expected;
  }

  // Pulses one joint's motor and judges what the joints did. The other motors have no effort.
  void try_joint(std::size_t joint) {
    const PowerOff after(*bench_);
    JointReport& own = report_.joints[joint];
    own.expected_inertia =
        apparent_inertia(plan_->controller, sample_, plan_->moving_mass_kg)[joint];
    const double range = range_of(plan_->controller, joint);
    const double most_effort = plan_->controller.joints[joint].max_effort;
    firmware::JointTrial trial({.joint = joint,
                                .rate_hz = plan_->controller.rate_hz,
                                .first_effort = plan_->first_effort_share * most_effort,
                                .most_effort = plan_->most_effort_share * most_effort,
                                .wanted_travel = kWantedTravel * range,
                                .largest_travel = kLargestTravel * range});
    double told = 0.0;
    while (trial.end() == firmware::TrialEnd::running) {
      drivers::JointCommand command{.enable = true};
      command.effort[joint] = trial.tick(sample_);
      if (trial.effort() != told) {
        told = trial.effort();
        tell(fmt::format("{}: pulses of {:.3g} {}", own.name, told, own.slides ? "N" : "N m"));
      }
      tick(command);
    }
    own.fit = trial.fit();
    own.effort = trial.effort();
    own.verdict = firmware::judge_trial(trial, joint, expected(joint));
    if (own.verdict == Verdict::passed) {
      own.verdict = firmware::judge_travel(own.travel, expected(joint));
    }
    if (own.verdict == Verdict::sample_bad) {
      report_.trouble = bench_->trouble();
    }
  }

  Bench* bench_;
  const CommissionPlan* plan_;
  const CommissionProgress* progress_;
  std::size_t joints_;
  drivers::JointSample sample_;
  CommissionReport report_;
};

}  // namespace

bool CommissionReport::has_passed() const {
  return trouble.empty() && !joints.empty() &&
         std::ranges::all_of(
             joints, [](const JointReport& joint) { return joint.verdict == Verdict::passed; });
}

std::array<double, firmware::kJointCount> apparent_inertia(const ControllerConfig& config,
                                                           const drivers::JointSample& sample,
                                                           double mass_kg) {
  const Vec3 joints(sample.position[0], sample.position[1], sample.position[2]);
  const firmware::Pose pose =
      firmware::Mechanism(config.mechanism).forward(joints, config.workspace_origin_D);
  const std::size_t count = firmware::joint_count(config.mechanism);
  const Vec3 mobility = firmware::joint_mobility(pose, count, mass_kg);
  std::array<double, firmware::kJointCount> apparent{};
  for (std::size_t i = 0; i < count; ++i) {
    apparent[i] = 1.0 / mobility[static_cast<Eigen::Index>(i)];
  }
  return apparent;
}

CommissionReport commission(Bench& bench, const CommissionPlan& plan,
                            const CommissionProgress& progress) {
  return Session(bench, plan, progress).run();
}

}  // namespace tactus::host
