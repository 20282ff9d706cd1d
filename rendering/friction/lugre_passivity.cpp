#include "rendering/friction/lugre_passivity.h"

#include <limits>

#include "rendering/geometry/portable_math.h"

namespace tactus::rendering {
namespace {

constexpr double kAnySpeed = std::numeric_limits<double>::infinity();
constexpr int kHalvings = 60;

// w s^2 / (s + sigma2) with s = sigma1 exp(-w^2): the condition's left side is v_d / 4 times this
// at the speed w v_d.
double demand(const FrictionParameters& p, double w) {
  const double damping = p.damping_s_per_m * exponential(-w * w);
  return damping > 0.0 ? w * damping * damping / (damping + p.viscous_s_per_m) : 0.0;
}

// Returns the speed at which the demand is largest: 1/w = w (4 - 2 q), q = s / (s + sigma2), whose
// sides fall and rise.
double most_demanding(const FrictionParameters& p) {
  double lower = 0.5;
  double upper = 0.7072;
  for (int i = 0; i < kHalvings; ++i) {
    const double w = 0.5 * (lower + upper);
    const double damping = p.damping_s_per_m * exponential(-w * w);
    const double q = damping / (damping + p.viscous_s_per_m);
    (w * w * (4.0 - 2.0 * q) < 1.0 ? lower : upper) = w;
  }
  return lower;
}

// The least speed at which the condition fails. The demand rises up to `peak`, and fails there.
double first_failure_m_per_s(const FrictionParameters& p, double peak) {
  double lower = 0.0;
  double upper = peak;
  for (int i = 0; i < kHalvings; ++i) {
    const double w = 0.5 * (lower + upper);
    (p.damping_fade_m_per_s * demand(p, w) <= 4.0 * p.coulomb ? lower : upper) = w;
  }
  return lower * p.damping_fade_m_per_s;
}

}  // namespace

LugrePassivity lugre_passivity(const FrictionParameters& p) {
  if (!has_bristles(p.kind) || !is_damped(p.kind) || p.damping_s_per_m <= 0.0 || p.coulomb <= 0.0) {
    return {.largest_fade_m_per_s = kAnySpeed, .safe_speed_m_per_s = kAnySpeed};
  }
  const double sigma1 = p.damping_s_per_m;
  const double peak = most_demanding(p);
  LugrePassivity result{.needed_viscous_s_per_m = sigma1 * (p.static_level - p.coulomb) / p.coulomb,
                        .largest_fade_m_per_s = 4.0 * p.coulomb / demand(p, peak)};
  const bool fades = p.damping_fade_m_per_s > 0.0;
  result.passive = p.viscous_s_per_m >= result.needed_viscous_s_per_m ||
                   (fades && p.damping_fade_m_per_s <= result.largest_fade_m_per_s);
  if (result.passive) {
    result.safe_speed_m_per_s = kAnySpeed;
  } else {
    result.safe_speed_m_per_s =
        fades ? first_failure_m_per_s(p, peak)
              : 4.0 * p.coulomb * (sigma1 + p.viscous_s_per_m) / (sigma1 * sigma1);
  }
  return result;
}

}  // namespace tactus::rendering
