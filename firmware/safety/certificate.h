// How stiff a surface this device can render and stay stable, as `tactus certify` measured it, and
// the check of a scene against that.
//
// Not for a tick: a scene is checked when it is loaded. Pure functions of their arguments; any
// thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "rendering/effects/effect.h"
#include "rendering/world/object.h"

namespace tactus::firmware {

inline constexpr std::size_t kMaxCertifiedPoints = 16;

// The largest safe stiffness of a surface with that damping.
struct CertifiedPoint {
  double damping_Ns_per_m = 0.0;
  double stiffness_N_per_m = 0.0;
};

struct StiffnessCertificate {
  std::array<CertifiedPoint, kMaxCertifiedPoints> points{};  // dampings rise
  std::size_t count = 0;                                     // 0: no certificate, nothing refused
  double margin = 1.0;  // up to this times its stiffness each point was stable

  [[nodiscard]] bool exists() const { return count > 0; }
  [[nodiscard]] std::span<const CertifiedPoint> all() const { return {points.data(), count}; }
};

// N/m: on straight lines between the points; 0 outside of the dampings that were measured.
double certified_stiffness(const StiffnessCertificate& certificate, double damping_Ns_per_m);

// What of a scene is stiffer than certified.
struct UncertifiedPart {
  enum class Kind : std::uint8_t { object, effect };
  Kind kind = Kind::object;
  std::size_t index = 0;           // of the objects or of the effects
  double stiffness_N_per_m = 0.0;  // where a texture makes it stiffest
  double damping_Ns_per_m = 0.0;
  double limit_N_per_m = 0.0;  // with that damping
  double most_damping_Ns_per_m = 0.0;
};

// The first object, or else the first effect with a spring, that is beyond the certificate; nothing
// without one. Each is taken by itself: surfaces that overlap and push together are not added up.
std::optional<UncertifiedPart> first_uncertified(const StiffnessCertificate& certificate,
                                                 std::span<const rendering::Object> objects,
                                                 std::span<const rendering::Effect> effects);

}  // namespace tactus::firmware
