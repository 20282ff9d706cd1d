#include "firmware/control/controller.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "firmware/limits.h"
#include "firmware/safety/faults.h"

namespace tactus::firmware {
namespace {

static_assert(sizeof(Controller) <= kMaxControllerBytes);

// Returns the first three entries: the controller's kJointCount joints.
Vec3 joints_of(const std::array<double, drivers::kMaxJoints>& values) {
  return {values[0], values[1], values[2]};
}

// Clears the joints beyond those of the mechanism, which a device may report.
void forget_beyond(std::size_t joint_count, drivers::JointSample& sample) {
  for (std::size_t joint = joint_count; joint < drivers::kMaxJoints; ++joint) {
    sample.position[joint] = 0.0;
    sample.velocity[joint] = 0.0;
    sample.effort[joint] = 0.0;
    sample.effort_known &= ~(1U << joint);
  }
}

bool all_finite(const Vec3& v) {
  return std::isfinite(v.x()) && std::isfinite(v.y()) && std::isfinite(v.z());
}

bool all_finite(const rendering::Touch& touch) {
  const rendering::ForceParts& parts = touch.parts;
  return all_finite(touch.force_W) && all_finite(touch.proxy_W) && all_finite(touch.normal_W) &&
         std::isfinite(touch.depth_m) && all_finite(parts.friction_W) &&
         all_finite(parts.texture_W) && all_finite(parts.effect_W) &&
         std::isfinite(parts.driven_power);
}

// The limits that hold a force back and therefore have a source.
constexpr std::uint64_t kForceLimits =
    kLimitForce | kLimitSlew | kLimitEffort | kLimitWorkspace | kLimitSpeed | kLimitPassivity;

}  // namespace

drivers::JointCommand Controller::tick(const drivers::JointSample& fresh, Request request) {
  Stopwatch watch(now_ns_);
  drivers::JointSample sample = fresh;
  sample.status |= write_status_;
  forget_beyond(joint_count(config_.mechanism), sample);
  open_record(sample, request);

  raise(loop_check_.check(std::exchange(loop_report_, {})));
  raise(sample_check_.check(sample));
  check_encoders(sample);
  advance_mode(sample.status, request);
  record_.stage_ns.check = watch.lap_ns();

  const bool located = locate(sample);
  record_.stage_ns.kinematics = watch.lap_ns();

  const rendering::Touch touched = touch(located);
  record_.stage_ns.touch = watch.lap_ns();

  record_touch(touched);
  const Vec3 force_W = limit_force(touched);
  const drivers::JointCommand command = command_joints(sample, force_W);
  record_.stage_ns.safety = watch.lap_ns();

  close_record(command);
  return command;
}

// Raises faults and limits. A fault stops at once, in any stage: the later stages see the mode
// `fault` and give zero.
void Controller::raise(std::uint64_t bits) {
  bits &= ~config_.safety.guards_off;
  raised_ |= bits;
  if ((bits & kFaultMask) != 0) {
    faults_ |= bits & kFaultMask;
    step_mode(Event::fault);
  }
}

// Applies an event to the mode and does the work of entering the new mode.
void Controller::step_mode(Event event) {
  const Mode from = mode_;
  mode_ = next_mode(from, event);
  if (mode_ == from) {
    return;
  }
  switch (mode_) {
    case Mode::init:
      faults_ = kNoFault;
      fault_joint_ = 0;
      break;
    case Mode::homing:
      break;
    case Mode::ready:
      // Homing moves the joints' zero, so the tool starts at its new position without contact.
      if (from == Mode::homing) {
        world_.reset();
        velocity_filter_.reset();
      }
      break;
    case Mode::active:
      force_limiter_.restart();
      sign_check_.restart();
      energy_.restart();
      passivity_.restart();
      break;
    case Mode::fault:
      ++record_.counters.faults_entered;
      break;
  }
}

// Applies the tick's device event and then its request. Faults of this tick have been applied
// already.
void Controller::advance_mode(std::uint32_t status, Request request) {
  if (!configured_) {
    raise(kFaultNotConfigured);
  }
  const bool referenced = is_referenced(status);
  if (mode_ == Mode::active && !referenced) {
    raise(kFaultReferenceLost);
  }
  step_mode(referenced ? Event::device_ready : Event::device_not_ready);

  const bool healthy = (raised_ & kFaultMask) == 0;
  switch (request) {
    case Request::none:
      break;
    case Request::home:
      step_mode(Event::home);
      break;
    case Request::enable:
      step_mode(Event::enable);
      break;
    case Request::disable:
      step_mode(Event::disable);
      break;
    // A reset in a tick with trouble would only raise the fault again.
    case Request::reset:
      if (healthy) {
        step_mode(Event::reset);
      }
      break;
    case Request::estop:
      raise(kFaultOperatorStop);
      break;
  }
}

// Runs the encoder guard while the device is referenced. Before, positions mean nothing, and homing
// changes their zero.
void Controller::check_encoders(const drivers::JointSample& sample) {
  const bool referenced = configured_ && is_referenced(sample.status) &&
                          (mode_ == Mode::ready || mode_ == Mode::active || mode_ == Mode::fault);
  if (!referenced) {
    encoder_guard_.rest();
    motion_guard_.rest();
  } else if ((raised_ & (kLimitStaleSample | kFaultJointNotFinite)) != 0) {
    encoder_guard_.pass();
  } else {
    raise(encoder_guard_.check(sample, held_effort_, record_.missed_ticks) &
          ~(mode_ == Mode::active ? kNoFault : kFaultTorqueWithoutMotion));
  }
}

// Runs the effort guards while the motors have power. The first joint found stays in fault_joint_
// until a reset.
void Controller::check_efforts(const drivers::JointSample& sample) {
  if (mode_ != Mode::active || pose_.status != kPoseGood) {
    effort_guard_.rest();
    sign_check_.pass();
    return;
  }
  if ((raised_ & kLimitStaleSample) != 0) {
    sign_check_.pass();
    return;
  }
  blame(effort_guard_.check(sample, pose_, held_effort_));
  if (record_.missed_ticks != 0) {
    sign_check_.pass();
  }
  blame(sign_check_.step(sample, pose_, held_effort_));
  raise(sign_check_.is_done() ? kNoFault : kLimitSignCheck);
}

// Raises the faults of a finding and notes its joint.
void Controller::blame(const EffortFinding& found) {
  const std::uint64_t faults = found.faults & ~config_.safety.guards_off;
  if (faults != kNoFault && fault_joint_ == 0) {
    fault_joint_ = found.joint;
  }
  raise(faults);
}

// Computes the tool's position and velocity. Returns false if the joints are not referenced or the
// kinematics fail; the tool then stays where it was, at rest.
bool Controller::locate(const drivers::JointSample& sample) {
  tool_.v_W.setZero();
  const bool expected = mode_ == Mode::ready || mode_ == Mode::active || mode_ == Mode::fault;
  if (!expected || !configured_ || !is_referenced(sample.status) ||
      (raised_ & kFaultJointNotFinite) != 0) {
    return false;
  }
  pose_ = mechanism_.forward(joints_of(sample.position), pose_.p_D);
  raise((pose_.status & kPoseNotConverged) != 0 ? kFaultKinematicsNotConverged : kNoFault);
  raise((pose_.status & kPoseSingular) != 0 ? kFaultKinematicsSingular : kNoFault);

  const Vec3 velocity = velocity_filter_.filter(tool_velocity(pose_, joints_of(sample.velocity)));
  if (!all_finite(pose_.p_D) || !all_finite(velocity)) {
    pose_ = Pose{};
    velocity_filter_.reset();
    raise(kFaultToolNotFinite);
    return false;
  }
  tool_.p_W = pose_.p_D - config_.workspace_origin_D;
  tool_.v_W = velocity;
  raise(workspace_walls_.check(tool_.p_W) | motion_guard_.check(velocity, energy_.held_W()));
  check_efforts(sample);
  return pose_.status == kPoseGood;
}

// Advances the changes of materials. They change the force no faster than an activation with the
// largest force does; without force they act at once.
void Controller::bring_changes_in() {
  if (!material_changes_.any()) {
    return;
  }
  if (mode_ != Mode::active) {
    material_changes_.finish(world_);
    return;
  }
  const double most_N =
      config_.safety.max_force_N * gain_per_tick(config_.safety.soft_start_s, config_.rate_hz);
  material_changes_.step(world_, most_N, length_of(tool_.v_W));
  raise(material_changes_.any() ? kLimitChange : kNoFault);
}

// Computes the touch. It does so in `ready` too, without force: the proxy then rests on the surface
// into which the tool is pushed, and activation raises the force from there.
rendering::Touch Controller::touch(bool located) {
  rendering::Touch touch;
  touch.proxy_W = tool_.p_W;
  if (!located || (mode_ != Mode::ready && mode_ != Mode::active)) {
    return touch;
  }
  bring_changes_in();
  touch = world_.touch(tool_);
  if (!all_finite(touch)) {
    raise(kFaultForceNotFinite);
    touch = rendering::Touch{};
    touch.proxy_W = tool_.p_W;
  }
  raise(touch.flags != rendering::kTouchClean ? kLimitTouch : kNoFault);
  return touch;
}

// Returns the rendered force with the forces of the guards, limited for a hand, N; zero in every
// mode but `active`. The order of the steps is that of firmware/README.md, "One tick".
Vec3 Controller::limit_force(const rendering::Touch& touch) {
  if (mode_ != Mode::active) {
    return Vec3::Zero();
  }
  const bool pushes =
      touch.contact != rendering::ContactKind::none || (raised_ & kLimitWorkspace) != 0;
  // The held force acted over the missed ticks, too.
  const double step_s = (1.0 + record_.missed_ticks) / config_.rate_hz;
  raise(passivity_.observe(energy_.settle(tool_.p_W, touch, step_s), pushes));
  if (mode_ != Mode::active) {
    return Vec3::Zero();
  }
  const Vec3 added_W = add_safety(pushes);
  const LimitedForce soft =
      force_limiter_.soften(touch.force_W + added_W, touch.parts.effect_W, pushes);
  // Until every motor has answered, the force stays so small that a reversed motor cannot hurt.
  if (!sign_check_.is_done()) {
    force_limiter_.hold_below(sign_check_.force_limit_N());
  }
  const SlowedForce slowed = motion_guard_.slow(soft.force_W, tool_.v_W);
  const LimitedForce limited = force_limiter_.limit(slowed.force_W);
  raise(soft.limits | slowed.limits | limited.limits);
  if ((raised_ & kForceLimits) != 0) {
    record_.limited_source =
        (raised_ & kLimitPassivity) != 0 ? energy_.most_giving() : strongest_part(touch, added_W);
  }
  return limited.force_W;
}

// Returns the force of the workspace walls and of the passivity controller, N.
Vec3 Controller::add_safety(bool pushes) {
  Vec3 added_W = passivity_.damp_W(tool_.v_W, pushes);
  raise(added_W != Vec3::Zero() ? kLimitPassivity : kNoFault);
  if ((raised_ & kLimitWorkspace) != 0) {
    added_W += workspace_walls_.push_W(tool_);
  }
  return added_W;
}

// Returns the joint efforts of the force and of the two compensations. The rendered force is scaled
// into the limits that gravity leaves, friction into the limits that both leave.
drivers::JointCommand Controller::command_joints(const drivers::JointSample& sample,
                                                 const Vec3& force_W) {
  Vec3 effort = joint_effort(pose_, force_W);
  if (!all_finite(effort)) {
    raise(kFaultCommandNotFinite);
  }
  drivers::JointCommand command;
  if (mode_ != Mode::active) {
    gravity_compensation_.rest();
    friction_compensation_.rest();
    energy_.hold(Vec3::Zero());
    command.home = mode_ == Mode::homing;
    command.power_off = mode_ == Mode::fault;
    return command;
  }
  const Vec3 held = hold_up(sample);
  const double scale = effort_scale(effort, config_.joints, held);
  raise(scale < 1.0 ? kLimitEffort : kNoFault);
  effort = scale * effort + held;
  force_limiter_.applied(scale * force_W);
  energy_.hold(scale * force_W);
  record_.force_commanded_W = to_triple(scale * force_W);
  if (friction_compensation_.is_on()) {
    effort = compensated(sample, effort, length_of(scale * force_W));
    if (mode_ != Mode::active) {  // the push was not finite: the motors get nothing
      energy_.hold(Vec3::Zero());
      record_.force_commanded_W = {};
      command.power_off = true;
      return command;
    }
  }
  for (std::size_t joint = 0; joint < kJointCount; ++joint) {
    // The efforts are within the limits except for rounding and the push of the sign check.
    const double most = config_.joints[joint].max_effort;
    const double push = sign_check_.push()[joint];
    command.effort[joint] =
        std::clamp(effort[static_cast<Eigen::Index>(joint)] + push, -most, most);
  }
  command.enable = true;
  return command;
}

// Returns the efforts that hold the mechanism's own weights, N or N m.
Vec3 Controller::hold_up(const drivers::JointSample& sample) {
  if (!gravity_compensation_.is_on()) {
    return Vec3::Zero();
  }
  const GravityHold hold =
      gravity_compensation_.hold(mechanism_, joints_of(sample.position), pose_);
  raise(hold.is_held_back ? kLimitGravity : kNoFault);
  for (std::size_t joint = 0; joint < kJointCount; ++joint) {
    record_.joint_gravity[joint] = hold.effort[static_cast<Eigen::Index>(joint)];
  }
  return hold.effort;
}

// Returns `effort` plus the compensation of the joints' friction. `force_N` is the size of the
// rendered force.
Vec3 Controller::compensated(const drivers::JointSample& sample, const Vec3& effort,
                             double force_N) {
  const PushRoom room{.pose = pose_,
                      .effort = effort,
                      .force_N = std::max(0.0, force_limiter_.max_force_N() - force_N)};
  const FrictionPush push =
      friction_compensation_.push(joints_of(sample.position), joints_of(sample.velocity), room);
  if (!all_finite(push.effort)) {
    raise(kFaultCommandNotFinite);
    return Vec3::Zero();
  }
  raise(push.is_held_back ? kLimitCompensation : kNoFault);
  Vec3 sum;
  for (std::size_t joint = 0; joint < kJointCount; ++joint) {
    const auto axis = static_cast<Eigen::Index>(joint);
    const double limit = config_.joints[joint].max_effort;
    sum[axis] = std::clamp(effort[axis] + push.effort[axis], -limit, limit);
    record_.joint_compensation[joint] = push.effort[axis];
  }
  return sum;
}

// Starts the record of the tick. Only counters and hash continue from the record before.
void Controller::open_record(const drivers::JointSample& sample, Request request) {
  raised_ = config_.safety.guards_off != kNoFault ? kLimitGuardsOff : kNoFault;
  const TelemetryRecord before = record_;
  record_ = TelemetryRecord{};
  record_.counters = before.counters;
  record_.state_hash = before.state_hash;
  record_.tick = next_tick_++;
  record_.request = request;
  record_.change = change_;
  change_ = ParameterChange{};
  record_.device_status = sample.status;
  record_.sample_age_us = sample.age_us;
  record_.loop_status = loop_report_.status;
  record_.missed_ticks = loop_report_.missed_ticks;
  record_.effort_known = sample.effort_known;
  record_.time_s = static_cast<double>(record_.tick) / config_.rate_hz;
  for (std::size_t joint = 0; joint < kJointCount; ++joint) {
    record_.joint_position[joint] = sample.position[joint];
    record_.joint_velocity[joint] = sample.velocity[joint];
    record_.joint_measured[joint] = sample.effort[joint];
  }
}

void Controller::record_touch(const rendering::Touch& touch) {
  record_.contact = touch.contact;
  record_.friction = touch.friction;
  record_.touch_flags = touch.flags;
  record_.object = touch.object;
  record_.sub_goals = touch.sub_goals;
  record_.planes = touch.planes;
  record_.proxy_W = to_triple(touch.proxy_W);
  record_.normal_W = to_triple(touch.normal_W);
  record_.force_rendered_W = to_triple(touch.force_W);
  record_.depth_m = touch.depth_m;
  record_.counters.touch_flagged += touch.flags != rendering::kTouchClean ? 1U : 0U;
}

void Controller::close_record(const drivers::JointCommand& command) {
  record_.mode = mode_;
  record_.faults = faults_;
  record_.fault_joint = fault_joint_;
  record_.limits = raised_ & kLimitMask;
  record_.energy_J = energy_.ledger_J();
  record_.passivity_J = passivity_.credit_J();
  held_effort_ = command.effort;
  record_.joint_effort = command.effort;
  record_.tool_p_W = to_triple(tool_.p_W);
  record_.tool_v_W = to_triple(tool_.v_W);
  record_.counters.stale_samples = sample_check_.stale_count();
  record_.counters.late_ticks = loop_check_.late_count();
  record_.counters.limited_ticks += record_.limits != 0 ? 1U : 0U;
  record_.state_hash = state_hash(record_, record_.state_hash);
}

void Controller::note_transfers(std::uint32_t write_status, std::uint32_t read_ns,
                                std::uint32_t write_ns) {
  write_status_ = write_status;
  record_.stage_ns.read = read_ns;
  record_.stage_ns.write = write_ns;
}

}  // namespace tactus::firmware
