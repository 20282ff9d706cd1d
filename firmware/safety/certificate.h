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

// The largest number of dampings at which a device is certified.
inline constexpr std::size_t kMaxCertifiedPoints = 16;

// The certificate: the certified stiffness at several dampings.
struct StiffnessCertificate {
  // The certified points, in order of rising damping.
  std::array<CertifiedPoint, kMaxCertifiedPoints> points{};
  // The number of points; 0: there is no certificate, so nothing is refused.
  std::size_t count = 0;
  // Each point was stable up to this many times its stiffness.
  double margin = 1.0;

  // Returns true if there is a certificate.
  [[nodiscard]] bool exists() const { return count > 0; }
  // Returns the certified points.
  [[nodiscard]] std::span<const CertifiedPoint> all() const { return {points.data(), count}; }
};

// Returns the certified stiffness, N/m, by linear interpolation between the points. It is 0 outside
// the measured dampings.
double certified_stiffness(const StiffnessCertificate& certificate, double damping_Ns_per_m);

// Returns the smallest certified stiffness between two dampings, N/m.
double least_certified_stiffness(const StiffnessCertificate& certificate, double from_Ns_per_m,
                                 double to_Ns_per_m);

// Returns true if that stiffness or damping is beyond the certificate, which must exist.
bool is_beyond(const StiffnessCertificate& certificate, const CertifiedPoint& felt);

// The part of a scene that is stiffer than certified, or several parts that push at one place.
// Messages name it.
struct UncertifiedPart {
  // An object, an effect, or a wall of the workspace box.
  enum class Kind : std::uint8_t { object, effect, wall };
  // Another part that pushes at the same place.
  struct Other {
    Kind kind = Kind::object;
    std::size_t index = 0;
  };
  // The largest number of other parts that are named.
  static constexpr std::size_t kMostOthers = 3;

  Kind kind = Kind::object;
  // The index into the objects, the effects or the walls (FeltWalls).
  std::size_t index = 0;
  // The stiffness of all parts together; the largest value of a texture.
  double stiffness_N_per_m = 0.0;
  // The damping of all parts together.
  double damping_Ns_per_m = 0.0;
  // The stiffness that is certified with that damping.
  double limit_N_per_m = 0.0;
  // The largest damping that was certified.
  double most_damping_Ns_per_m = 0.0;
  // The number of other parts that push there.
  std::size_t other_count = 0;
  // The number of them that are in `others`.
  std::size_t listed = 0;
  std::array<Other, kMostOthers> others{};
};

// Returns the kind and the index of part `number` of the scene, counted as in part_of().
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
