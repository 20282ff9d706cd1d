#include "rendering/friction/grain.h"

namespace tactus::rendering {

FrictionForce<Vec3> update_friction(const FrictionParameters& parameters, const Grain& grain,
                                    FrictionMemory<Vec3>& memory, const Vec3& displacement_m,
                                    double normal_force_N, double step_s) {
  FrictionForce<Vec3> force =
      update_friction(parameters, memory, through(grain, displacement_m), normal_force_N, step_s);
  force.force_N = through(grain, force.force_N);
  force.mean_force_N = through(grain, force.mean_force_N);
  return force;
}

}  // namespace tactus::rendering
