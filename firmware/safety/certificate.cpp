#include "firmware/safety/certificate.h"

#include <algorithm>

#include "firmware/safety/pushing_together.h"
#include "rendering/limits.h"

namespace tactus::firmware {
namespace {

// Checks one part by itself. Returns it with its limits if it is beyond the certificate.
std::optional<UncertifiedPart> beyond_alone(const StiffnessCertificate& certificate,
                                            const FeltScene& scene, std::size_t number) {
  const CertifiedPoint felt = part_of(scene, number).felt;
  if (!is_beyond(certificate, felt)) {
    return std::nullopt;
  }
  const UncertifiedPart::Other name = name_of_part(scene, number);
  return UncertifiedPart{.kind = name.kind,
                         .index = name.index,
                         .stiffness_N_per_m = felt.stiffness_N_per_m,
                         .damping_Ns_per_m = felt.damping_Ns_per_m,
                         .limit_N_per_m = certified_stiffness(certificate, felt.damping_Ns_per_m),
                         .most_damping_Ns_per_m = certificate.all().back().damping_Ns_per_m};
}

}  // namespace

UncertifiedPart::Other name_of_part(const FeltScene& scene, std::size_t number) {
  const std::size_t objects = scene.objects.size();
  const std::size_t effects = scene.effects.size();
  if (number < objects) {
    return {UncertifiedPart::Kind::object, number};
  }
  return number < objects + effects
             ? UncertifiedPart::Other{UncertifiedPart::Kind::effect, number - objects}
             : UncertifiedPart::Other{UncertifiedPart::Kind::wall, number - objects - effects};
}

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
  // Nothing was measured there, so nothing is certified.
  return 0.0;
}

double least_certified_stiffness(const StiffnessCertificate& certificate, double from_Ns_per_m,
                                 double to_Ns_per_m) {
  double least = std::min(certified_stiffness(certificate, from_Ns_per_m),
                          certified_stiffness(certificate, to_Ns_per_m));
  // The certified stiffness is linear between the points, so its least value is at an end or at a
  // point.
  for (const CertifiedPoint& point : certificate.all()) {
    if (point.damping_Ns_per_m > from_Ns_per_m && point.damping_Ns_per_m < to_Ns_per_m) {
      least = std::min(least, point.stiffness_N_per_m);
    }
  }
  return least;
}

bool is_beyond(const StiffnessCertificate& certificate, const CertifiedPoint& felt) {
  return felt.damping_Ns_per_m > certificate.all().back().damping_Ns_per_m ||
         felt.stiffness_N_per_m > certified_stiffness(certificate, felt.damping_Ns_per_m);
}

std::optional<UncertifiedPart> first_uncertified(const StiffnessCertificate& certificate,
                                                 std::span<const rendering::Object> objects,
                                                 std::span<const rendering::Effect> effects,
                                                 const SceneFeel& feel) {
  if (!certificate.exists()) {
    return std::nullopt;
  }
  const FeltScene scene{.objects = objects, .effects = effects, .feel = feel};
  for (std::size_t i = 0; i < scene.size(); ++i) {
    if (auto part = beyond_alone(certificate, scene, i)) {
      return part;
    }
  }
  const bool fits_world =
      objects.size() <= rendering::kMaxObjects && effects.size() <= rendering::kMaxEffects;
  return fits_world ? first_uncertified_together(certificate, scene) : std::nullopt;
}

std::optional<UncertifiedPart> uncertified_with(const StiffnessCertificate& certificate,
                                                const FeltScene& scene, std::uint32_t object) {
  if (!certificate.exists()) {
    return std::nullopt;
  }
  auto part = beyond_alone(certificate, scene, object);
  return part ? part : first_uncertified_with(certificate, scene, object);
}

}  // namespace tactus::firmware
