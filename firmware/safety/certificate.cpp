#include "firmware/safety/certificate.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <variant>

namespace tactus::firmware {
namespace {

// K and B as the hand meets them at most.
CertifiedPoint felt_at_most(const rendering::Object& object) {
  double factor = 1.0;
  for (const rendering::TextureLayer& layer : object.detail.layers) {
    if (layer.use == rendering::TextureUse::stiffness) {
      factor = std::max(layer.low, layer.high);
    }
  }
  return {.damping_Ns_per_m = object.material.damping_Ns_per_m,
          .stiffness_N_per_m = factor * object.material.stiffness_N_per_m};
}

CertifiedPoint snap_of(const rendering::SnapLaw& law) {
  return {.damping_Ns_per_m = law.damping_Ns_per_m, .stiffness_N_per_m = law.stiffness_N_per_m};
}

// The steepest slope of the magnet's pull, S (c^2 - 2 d^2) / (d^2 + c^2)^(5/2). A pole that pulls
// is a spring of S / c^3 at its middle. One that pushes away is steepest at d^2 = 3 c^2 / 2, with
// -2 S / (5/2)^(5/2) / c^3.
CertifiedPoint core_of(const rendering::Magnet& magnet) {
  const double middle = 1.5 * std::numbers::sqrt3 * magnet.strength_N / magnet.core_m;
  const double away = -2.0 / (2.5 * 2.5 * std::sqrt(2.5));
  return {.stiffness_N_per_m = middle >= 0.0 ? middle : away * middle};
}

// The slope of the drag at the speed at which it reaches its largest force: it is steepest there.
CertifiedPoint drag_of(const rendering::FluidDrag& drag, double max_force_N) {
  const double linear = drag.linear_Ns_per_m;
  return {.damping_Ns_per_m =
              std::sqrt(linear * linear + 4.0 * drag.quadratic_Ns2_per_m2 * max_force_N)};
}

// Both are 0 for an effect whose force changes neither with place nor with speed.
CertifiedPoint felt_at_most(const rendering::Effect& effect) {
  const rendering::EffectLaw& law = effect.law;
  if (const auto* spring = std::get_if<rendering::Spring>(&law)) {
    return {.stiffness_N_per_m = spring->stiffness_N_per_m};
  }
  if (const auto* damped = std::get_if<rendering::SpringDamper>(&law)) {
    return {.damping_Ns_per_m = damped->damping_Ns_per_m,
            .stiffness_N_per_m = damped->spring.stiffness_N_per_m};
  }
  if (const auto* magnet = std::get_if<rendering::Magnet>(&law)) {
    return core_of(*magnet);
  }
  if (const auto* drag = std::get_if<rendering::FluidDrag>(&law)) {
    return drag_of(*drag, effect.max_force_N);
  }
  if (const auto* stick = std::get_if<rendering::StickSlip>(&law)) {
    return {.stiffness_N_per_m = stick->stiffness_N_per_m};
  }
  if (const auto* point = std::get_if<rendering::SnapToPoint>(&law)) {
    return snap_of(point->law);
  }
  if (const auto* line = std::get_if<rendering::SnapToLine>(&law)) {
    return snap_of(line->law);
  }
  if (const auto* plane = std::get_if<rendering::SnapToPlane>(&law)) {
    return snap_of(plane->law);
  }
  return {};
}

// The first of `parts` that is beyond the certificate.
template <class Part>
std::optional<UncertifiedPart> first_beyond(const StiffnessCertificate& certificate,
                                            std::span<const Part> parts,
                                            UncertifiedPart::Kind kind) {
  const double most_damping = certificate.all().back().damping_Ns_per_m;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const auto [damping, stiffness] = felt_at_most(parts[i]);
    const double limit = certified_stiffness(certificate, damping);
    if (damping > most_damping || stiffness > limit) {
      return UncertifiedPart{.kind = kind,
                             .index = i,
                             .stiffness_N_per_m = stiffness,
                             .damping_Ns_per_m = damping,
                             .limit_N_per_m = limit,
                             .most_damping_Ns_per_m = most_damping};
    }
  }
  return std::nullopt;
}

}  // namespace

double certified_stiffness(const StiffnessCertificate& certificate, double damping_Ns_per_m) {
  const auto points = certificate.all();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const CertifiedPoint& point = points[i];
    if (damping_Ns_per_m == point.damping_Ns_per_m) {
      return point.stiffness_N_per_m;
    }
    if (i > 0 && damping_Ns_per_m > points[i - 1].damping_Ns_per_m &&
        damping_Ns_per_m < point.damping_Ns_per_m) {
      const CertifiedPoint& before = points[i - 1];
      const double share = (damping_Ns_per_m - before.damping_Ns_per_m) /
                           (point.damping_Ns_per_m - before.damping_Ns_per_m);
      return before.stiffness_N_per_m +
             share * (point.stiffness_N_per_m - before.stiffness_N_per_m);
    }
  }
  return 0.0;
}

std::optional<UncertifiedPart> first_uncertified(const StiffnessCertificate& certificate,
                                                 std::span<const rendering::Object> objects,
                                                 std::span<const rendering::Effect> effects) {
  if (!certificate.exists()) {
    return std::nullopt;
  }
  const auto object = first_beyond(certificate, objects, UncertifiedPart::Kind::object);
  return object ? object : first_beyond(certificate, effects, UncertifiedPart::Kind::effect);
}

}  // namespace tactus::firmware
