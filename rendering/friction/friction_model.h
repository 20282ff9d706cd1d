// The friction models: from a displacement along the surface, or of a joint, and the normal force
// to the friction force, once a tick.
//
// One code serves both uses. `Vector` is `double` in a joint and `Vec3`, a vector in the tangent
// plane, under a proxy; forces are N and displacements m, or N m and rad in a turning joint.
//
// Sign: as the papers have it, m dv/dt = u - F: F points along the motion, and what the mover feels
// is -F.
//
// Assumption of a tick: the displacement happens at constant velocity, under a constant normal
// force. The equations are then solved exactly (elasto-plastic: to second order), so that no speed,
// stiffness or step makes them unstable.
#pragma once

#include "rendering/friction/friction_parameters.h"
#include "rendering/friction/registered_models.h"
#include "rendering/friction/tangent.h"
#include "rendering/geometry/vector.h"

namespace tactus::rendering {

// The friction cone of a static and a dynamic coefficient of friction.
constexpr FrictionParameters cone_friction(double static_coefficient, double dynamic_coefficient) {
  return {.kind = FrictionKind::cone,
          .coulomb = dynamic_coefficient,
          .static_level = static_coefficient};
}

// Returns the parameters with all terms per newton of normal force times a factor, as under so many
// times the normal force.
constexpr FrictionParameters scaled(FrictionParameters parameters, double factor) {
  parameters.coulomb *= factor;
  parameters.static_level *= factor;
  parameters.viscous_s_per_m *= factor;
  parameters.damping_s_per_m *= factor;
  return parameters;
}

// The parameters that a surface has if its scene leaves them out.
inline constexpr FrictionParameters kSurfaceFriction{
    .stribeck_velocity_m_per_s = 0.01,
    .stribeck_exponent = 2.0,
    .stick_velocity_m_per_s = 0.005,
    .elastic_fraction = 0.7,
};

// Returns true if the model has the parameter on a surface. A cone has no stiffness there: it
// sticks by the surface's own (surface_friction.h).
constexpr bool has_on_surface(FrictionKind kind, double FrictionParameters::* parameter) {
  const bool is_cone_stiffness =
      kind == FrictionKind::cone && parameter == &FrictionParameters::stiffness_N_per_m;
  return !is_cone_stiffness && kFrictionModels[static_cast<std::size_t>(kind)].has(parameter);
}

// Returns false if there is a static level, and the model has no friction at rest because its
// dynamic level is 0.
constexpr bool rubs_at_rest(const FrictionParameters& parameters) {
  return parameters.kind == FrictionKind::cone || parameters.coulomb > 0.0 ||
         !(parameters.static_level > 0.0);
}

// Returns true if every number is finite and within the bounds above.
bool valid(const FrictionParameters& parameters);

template <typename Vector>
struct FrictionForce {
  Vector force_N = zero_tangent<Vector>();  // at the tick's end
  // Over the tick: times the displacement it is the work of the tick, to rounding. The audit of
  // energy pairs these two. (Held over the next tick, as a device does, a force works otherwise:
  // see sampled_device.h.)
  Vector mean_force_N = zero_tangent<Vector>();
  Vector bristle_m = zero_tangent<Vector>();  // z at the tick's end; zero if rigid
  bool slipping = false;                      // of bristles: more than half of the motion was slip
};

// Computes one tick. The parameters must be valid, the displacement finite, step_s > 0. A normal
// force that is zero, negative or not a number means no contact: the force is zero, and the memory
// starts over.
//
// These hold for W = mean_force_N . displacement_m summed over ticks, from a new memory:
// - W >= stored_J(), to rounding: no motion and no course of the normal force makes a model give
// out
//   energy. Of lugre and elasto_plastic this holds if lugre_passivity() says so.
// - |elastic_force_N| <= Fs N (Fc N where there is no Fs).
// - rotated inputs give rotated outputs.
// Real time: no heap, bounded time.
template <typename Vector>
FrictionForce<Vector> update_friction(const FrictionParameters& parameters,
                                      FrictionMemory<Vector>& memory, const Vector& displacement_m,
                                      double normal_force_N, double step_s);

extern template FrictionForce<double> update_friction(const FrictionParameters&,
                                                      FrictionMemory<double>&, const double&,
                                                      double, double);
extern template FrictionForce<Vec3> update_friction(const FrictionParameters&,
                                                    FrictionMemory<Vec3>&, const Vec3&, double,
                                                    double);

// The largest force at rest, N per N.
constexpr double holding_level(const FrictionParameters& parameters) {
  return has_static_level(parameters.kind) ? parameters.static_level : parameters.coulomb;
}

// g(v): what a steady slip at `speed_m_per_s` (>= 0) takes, N per N, without the viscous term.
double steady_level(const FrictionParameters& parameters, double speed_m_per_s);

// sigma1 at that speed, N s/m per N.
double damping_at(const FrictionParameters& parameters, double speed_m_per_s);

// Returns the energy that the bristle stores: sigma0 z^2/2, or 0 if it is rigid.
template <typename Vector>
double stored_J(const FrictionParameters& parameters, const FrictionMemory<Vector>& memory) {
  const double stiffness = parameters.stiffness_N_per_m;
  return stiffness > 0.0 ? 0.5 * dot(memory.elastic_force_N, memory.elastic_force_N) / stiffness
                         : 0.0;
}

}  // namespace tactus::rendering
