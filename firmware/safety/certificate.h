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

#include "firmware/safety/scene_part.h"

namespace tactus::firmware {

inline constexpr std::size_t kMaxCertifiedPoints = 16;

struct StiffnessCertificate {
  std::array<CertifiedPoint, kMaxCertifiedPoints> points{};  // dampings rise
  std::size_t count = 0;                                     // 0: no certificate, nothing refused
  double margin = 1.0;  // up to this times its stiffness each point was stable

  [[nodiscard]] bool exists() const { return count > 0; }
  [[nodiscard]] std::span<const CertifiedPoint> all() const { return {points.data(), count}; }
};

// N/m: on straight lines between the points; 0 outside of the dampings that were measured.
double certified_stiffness(const StiffnessCertificate& certificate, double damping_Ns_per_m);

// The smallest of those between two dampings.
double least_certified_stiffness(const StiffnessCertificate& certificate, double from_Ns_per_m,
                                 double to_Ns_per_m);

// True if that stiffness and damping is beyond the certificate.
bool is_beyond(const StiffnessCertificate& certificate, const CertifiedPoint& felt);

// Names what is stiffer than certified in a scene: one part, or several that push at one place.
struct UncertifiedPart {
  enum class Kind : std::uint8_t { object, effect, wall };  // wall: of the workspace
  struct Other {
    Kind kind = Kind::object;
    std::size_t index = 0;
  };
  static constexpr std::size_t kMostOthers = 3;

  Kind kind = Kind::object;
  std::size_t index = 0;           // of the objects, the effects or the walls (FeltWalls)
  double stiffness_N_per_m = 0.0;  // where a texture makes it stiffest; of all together
  double damping_Ns_per_m = 0.0;   // of all together
  double limit_N_per_m = 0.0;      // with that damping
  double most_damping_Ns_per_m = 0.0;
  std::size_t other_count = 0;  // parts that push there too
  std::size_t listed = 0;       // of these, the first in `others`
  std::array<Other, kMostOthers> others{};
};

// Names part `number` of the scene.
UncertifiedPart::Other name_of_part(const FeltScene& scene, std::size_t number);

// The first object, or else the first effect with a spring or wall of the workspace, that is beyond
// the certificate by itself; or else the first parts that are beyond it where they push together
// (safety/pushing_together.h); nothing without a certificate.
std::optional<UncertifiedPart> first_uncertified(const StiffnessCertificate& certificate,
                                                 std::span<const rendering::Object> objects,
                                                 std::span<const rendering::Effect> effects,
                                                 const SceneFeel& feel = {});

// The same of one object, and of what pushes together with it.
std::optional<UncertifiedPart> uncertified_with(const StiffnessCertificate& certificate,
                                                const FeltScene& scene, std::uint32_t object);

}  // namespace tactus::firmware
