// The largest stiffness that the device can render without instability, as `tactus certify`
// measured it, and the check of a scene against it.
//
// Not for a tick: a scene is checked when it is loaded. All are pure functions of their arguments,
// for any thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "firmware/safety/scene_part.h"

namespace tactus::firmware {

inline constexpr std::size_t kMaxCertifiedPoints = 16;

// The certificate: the certified stiffness at several dampings.
struct StiffnessCertificate {
  std::array<CertifiedPoint, kMaxCertifiedPoints> points{};  // in order of rising damping
  std::size_t count = 0;  // 0: no certificate, so nothing is refused
  double margin = 1.0;    // each point was stable up to this times its stiffness

  [[nodiscard]] bool exists() const { return count > 0; }
  [[nodiscard]] std::span<const CertifiedPoint> all() const { return {points.data(), count}; }
};

// Returns the certified stiffness, N/m, by linear interpolation between the points. It is 0 outside
// the measured dampings.
double certified_stiffness(const StiffnessCertificate& certificate, double damping_Ns_per_m);

// Returns the smallest certified stiffness between two dampings, N/m.
double least_certified_stiffness(const StiffnessCertificate& certificate, double from_Ns_per_m,
                                 double to_Ns_per_m);

// Returns true if that stiffness and damping is beyond the certificate.
bool is_beyond(const StiffnessCertificate& certificate, const CertifiedPoint& felt);

// The part of a scene that is stiffer than certified, or several parts that push at one place.
struct UncertifiedPart {
  enum class Kind : std::uint8_t { object, effect, wall };  // wall: of the workspace box
  struct Other {
    Kind kind = Kind::object;
    std::size_t index = 0;
  };
  static constexpr std::size_t kMostOthers = 3;

  Kind kind = Kind::object;
  std::size_t index = 0;           // index into the objects, effects or walls (FeltWalls)
  double stiffness_N_per_m = 0.0;  // of all parts together; the largest value of a texture
  double damping_Ns_per_m = 0.0;   // of all parts together
  double limit_N_per_m = 0.0;      // certified with that damping
  double most_damping_Ns_per_m = 0.0;
  std::size_t other_count = 0;  // number of other parts that push there
  std::size_t listed = 0;       // number of them that are in `others`
  std::array<Other, kMostOthers> others{};
};

// Returns the kind and the index of part `number` of the scene.
UncertifiedPart::Other name_of_part(const FeltScene& scene, std::size_t number);

// Returns the first part that is beyond the certificate by itself: an object, or else an effect
// with a spring or a wall of the workspace. Otherwise returns the first parts that are beyond it
// where they push together (safety/pushing_together.h). Returns nothing without a certificate.
std::optional<UncertifiedPart> first_uncertified(const StiffnessCertificate& certificate,
                                                 std::span<const rendering::Object> objects,
                                                 std::span<const rendering::Effect> effects,
                                                 const SceneFeel& feel = {});

// Returns the same for one object and the parts that push together with it.
std::optional<UncertifiedPart> uncertified_with(const StiffnessCertificate& certificate,
                                                const FeltScene& scene, std::uint32_t object);

}  // namespace tactus::firmware
