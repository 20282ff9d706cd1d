// The friction of soft fingers about their contact normals.
#include <algorithm>
#include <array>
#include <numbers>
#include <span>

#include "rendering/bodies/finger_grip.h"
#include "rendering/geometry/portable_math.h"

namespace tactus::rendering {
namespace {

// A grip goes on from tick to tick while its normal turns by less than the arccosine of this.
constexpr double kSameGrip = 0.5;
// The torque of a disc that slips over the friction times the normal force and the radius, for
// Hertz's pressure.
constexpr double kHertzTorque = 3.0 * std::numbers::pi / 16.0;

}  // namespace

double FingerGrips::past_spin(const FingerGrip& grip) const {
  const auto old = std::span(grips_).first(count_);
  const auto found = std::ranges::find_if(old, [&](const SolvedGrip& past) {
    return past.given.body == grip.body && past.given.tool == grip.tool &&
           past.given.normal_W.dot(grip.normal_W) > kSameGrip;
  });
  return found == old.end() ? 0.0 : found->spin;
}

double FingerGrips::most_spin(const SolvedGrip& grip, const SolverBody& body) const {
  const Vec3 impulse = impulse_of(grip, body.velocity_at(grip.arm_W));
  const double push = -impulse.dot(grip.given.normal_W);
  if (!(push > 0.0)) {
    return 0.0;
  }
  const double radius_m = cube_root(yield_m3_per_N_ * push / step_s_);
  return kHertzTorque * grip.given.friction * push * radius_m;
}

void FingerGrips::limit_spins(std::span<SolverBody> bodies) {
  for (std::size_t i = 0; yield_m3_per_N_ > 0.0 && i < count_; ++i) {
    SolvedGrip& grip = grips_[i];
    SolverBody& body = bodies[grip.given.body];
    const Vec6 torque = spatial(Vec3::Zero(), grip.given.normal_W);
    grip.spin_answer = body.answer_to(torque);
    const double mobility = dot(torque, grip.spin_answer);
    grip.spin_inertia = mobility > 0.0 ? 1.0 / mobility : 0.0;
    const double most = most_spin(grip, body);
    const double spin = std::clamp(grip.spin, -most, most);
    body.gain(spin - grip.spin, grip.spin_answer);
    grip.spin = spin;
  }
}

// The tool itself does not turn.
void FingerGrips::solve_spins(std::span<SolverBody> bodies) {
  for (std::size_t i = 0; yield_m3_per_N_ > 0.0 && i < count_; ++i) {
    SolvedGrip& grip = grips_[i];
    SolverBody& body = bodies[grip.given.body];
    const double turning = grip.given.normal_W.dot(body.velocity().tail<3>());
    const double most = most_spin(grip, body);
    const double spin = std::clamp(grip.spin - grip.spin_inertia * turning, -most, most);
    body.gain(spin - grip.spin, grip.spin_answer);
    grip.spin = spin;
  }
}

void FingerGrips::add_spins(std::span<Vec6> wrenches) const {
  for (std::size_t i = 0; yield_m3_per_N_ > 0.0 && i < count_; ++i) {
    const SolvedGrip& grip = grips_[i];
    wrenches[grip.given.body].tail<3>() += grip.spin * grip.given.normal_W;
  }
}

void FingerGrips::transfer(StateArchive& archive, std::uint32_t bodies) {
  if (!(yield_m3_per_N_ > 0.0)) {
    return;
  }
  archive.up_to(count_, kMostGrips);
  for (std::size_t i = 0; i < count_ && archive.good(); ++i) {
    FingerGrip& given = grips_[i].given;
    archive.up_to(given.body, bodies);
    archive.up_to(given.tool, kMaxTools);
    archive(given.normal_W, grips_[i].spin);
  }
}

}  // namespace tactus::rendering
