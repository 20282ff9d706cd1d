// The capsule's length follows the number of triangles that its gathering tested: halved or doubled
// at most, toward kWantedTests. Its slimness follows how the proxy left: far along the axis makes
// the next one slimmer, through the side stouter.
#include "rendering/contact/capsule_plan.h"

#include <algorithm>

namespace tactus::rendering {
namespace {

// A sphere at rest looks at about 100 triangles whatever the length, so capsules shorter than
// kLeastLength_m save nothing. The capsule grows beyond kLongLength_m only if it lasted less than a
// tick and cost few tests: a tool that jumps over a coarse mesh.
constexpr double kLeastLength_m = 0.2e-3;
constexpr double kLongLength_m = 2.5e-3;
constexpr double kMostLength_m = 16e-3;
constexpr double kWantedTests = 128.0;
constexpr double kFewTests = 24.0;
// The capsule's length is between kLeastSlimness and kMostSlimness times its radius.
constexpr double kLeastRadius_m = 10e-6;
constexpr double kLeastSlimness = 4.0;
constexpr double kMostSlimness = 32.0;
// A capsule that is gathered in the same tick as the one before is longer by this.
constexpr double kLonger = 2.0;
// The proxy left through the end if it came farther than this share of the length.
constexpr double kStraight = 0.8;
// The factors of the slimness after a straight and after a curved path.
constexpr double kSlimmer = 1.4;
constexpr double kStouter = 0.7;

}  // namespace

Capsule CapsulePlan::next(const Vec3& last_start, const Vec3& p, bool again) {
  const Vec3 came = p - last_start;
  const double distance = came.norm();
  const bool straight = distance > kStraight * length_m_;
  slimness_ =
      std::clamp(slimness_ * (straight ? kSlimmer : kStouter), kLeastSlimness, kMostSlimness);
  if (again) {
    slimness_ = kLeastSlimness;
    length_m_ = std::min(kLonger * length_m_, kLongLength_m);
  }
  length_m_ = std::clamp(length_m_, kLeastLength_m, kMostLength_m);
  const double radius = std::max(kLeastRadius_m, length_m_ / slimness_);
  // The direction of the last motion is known unless the proxy hardly moved or jumped.
  const bool known = distance > kLeastRadius_m && distance < kMostLength_m;
  return {.start = p,
          .axis = known ? Vec3{came * (length_m_ / distance)} : Vec3{Vec3::Zero()},
          .radius = radius};
}

// A capsule of k times the length is taken to test k times the triangles. A sparse place may have a
// longer capsule than kLongLength_m, but it does not grow while one capsule lasts a tick.
void CapsulePlan::learn(std::size_t tested, bool lasted) {
  const double tests = 1.0 + static_cast<double>(tested);
  const double length = length_m_ * std::clamp(kWantedTests / tests, 0.5, 2.0);
  const double sparse = length_m_ * std::clamp(kFewTests / tests, 0.5, lasted ? 1.0 : 2.0);
  length_m_ = std::max(std::min(length, kLongLength_m), sparse);
}

void CapsulePlan::limit() {
  length_m_ = std::min(length_m_, kLongLength_m);
}

void CapsulePlan::shorten() {
  length_m_ = kLeastLength_m;
}

}  // namespace tactus::rendering
