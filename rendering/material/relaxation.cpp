#include "rendering/material/relaxation.h"

#include <algorithm>

namespace tactus::rendering {
namespace {

// The shortest step that two residuals may ask for, in units of the plain one, and how much longer
// the next tick tries again.
constexpr double kShortest = 0.05;
constexpr double kLengthening = 1.5;
// Residuals that differ by less say nothing: a tenth of a millinewton at 1000 N/m.
constexpr double kAlike_m = 1e-7;
// A tick at rest shortens the steps by this factor; one in which the tool moves by kRestless_m
// allows whole ones.
constexpr double kFading = 0.85;
constexpr double kRestless_m = 2e-6;
// Below this share no step is taken: 43 ticks after a tool has come to rest.
constexpr double kAtRest = 1e-3;

}  // namespace

void Relaxation::begin_tick(double moved_m, bool continues) {
  ceiling_ = std::min(1.0, kFading * ceiling_ + moved_m / kRestless_m);
  share_ = std::min(1.0, kLengthening * share_);
  has_residual_ = has_residual_ && continues;
}

void Relaxation::restart() {
  has_residual_ = false;
  share_ = 1.0;
}

double Relaxation::share_of(const Vec3& residual) {
  if (has_residual_) {
    const Vec3 change = residual - residual_;
    const double squared = change.squaredNorm();
    if (squared > kAlike_m * kAlike_m) {
      share_ = std::clamp(-share_ * residual_.dot(change) / squared, kShortest, 1.0);
    }
  }
  residual_ = residual;
  has_residual_ = true;
  return std::min(share_, ceiling_);
}

bool Relaxation::is_at_rest() const {
  return ceiling_ < kAtRest;
}

}  // namespace tactus::rendering
