#include "rendering/effects/snap.h"

#include <algorithm>

namespace tactus::rendering {

LawForce snap(const SnapLaw& law, const Vec3& offset, const Vec3& velocity, double most) {
  const double r = offset.norm();
  if (!(r < law.capture_m)) {
    return {};
  }
  const double grip = std::min(1.0, 2.0 * (1.0 - r / law.capture_m));
  const double pull = law.stiffness_N_per_m * std::min(r, law.capture_m - r);
  LawForce force{.damping_W = -grip * law.damping_Ns_per_m * velocity};
  if (r > 0.0) {
    force.elastic_W = std::min(pull, most) / r * offset;
  }
  return force;
}

// The integral is that of the rising side, of a level top where the bound cuts it off, and the
// mirror image of the rising side.
double snap_energy(const SnapLaw& law, double r, double most) {
  const double half = 0.5 * law.capture_m;
  const double rising = spring_energy(law.stiffness_N_per_m, std::min(r, half), most);
  if (r <= half) {
    return rising;
  }
  const double left = std::max(0.0, law.capture_m - r);
  return 2.0 * rising - spring_energy(law.stiffness_N_per_m, left, most);
}

}  // namespace tactus::rendering
