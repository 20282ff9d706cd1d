// The friction models: from a displacement along the surface, or of a joint, and the normal force
// to the friction force, once a tick.
//
// One code serves both uses. `Vector` is `double` in a joint and `Vec3`, a vector in the tangent
// plane, under a proxy; forces are N and displacements m, or N m and rad in a turning joint.
//
// Sign: as the papers have it, m dv/dt = u - F: F points along the motion, and what the mover feels
// is -F.
//
// Normal force. The levels Fc and Fs, the bristle damping sigma1 and the viscous term sigma2 are
// per newton of it; where none is given it is 1 N and they are N and N s/m. The bristle stiffness
// sigma0 is not: a load that grows adds no tangential force by itself (Mindlin and Deresiewicz, J.
// Applied Mechanics 20, 1953), just as a stuck proxy does not move when it is pressed. So a
// changing load stores no energy: sigma0 z^2/2 does not know it, and what a falling load makes of
// it is lost with the force, which is cut to Fs N.
//
// Assumption of a tick: the displacement happens at constant velocity, under a constant normal
// force. The equations are then solved exactly (elasto-plastic: to second order), so that no speed,
// stiffness or step makes them unstable.
#pragma once

#include <cstddef>
#include <cstdint>

#include "rendering/friction/tangent.h"
#include "rendering/geometry/vector.h"

namespace tactus::rendering {

inline constexpr std::size_t kFrictionKinds = 7;
enum class FrictionKind : std::uint8_t {
  cone = 0,             // Melder and Harwin: sticks up to Fs, slips at Fc until it is turned back
  coulomb_viscous = 1,  // Fc, and sigma2 times the velocity
  stribeck = 2,         // Coulomb and viscous, with g(v) falling from Fs to Fc
  karnopp = 3,          // sticks below a band of velocities up to Fs, slips at Fc
  dahl = 4,             // a bristle that yields toward Fc
  lugre = 5,            // a bristle that yields toward g(v), with damping
  elasto_plastic = 6,   // LuGre whose bristle does not yield up to a fraction of Fc: no drift
};

// Returns true if the model has a static level Fs of its own; the others stick up to Fc.
constexpr bool has_static_level(FrictionKind kind) {
  return kind != FrictionKind::dahl && kind != FrictionKind::coulomb_viscous;
}

// The normal force where none is given, as in a joint.
inline constexpr double kNoNormalForce_N = 1.0;

struct FrictionParameters {
  FrictionKind kind = FrictionKind::cone;
  double coulomb = 0.0;          // Fc, N per N of normal force
  double static_level = 0.0;     // Fs, the same; >= coulomb. dahl and coulomb_viscous do not use it
  double viscous_s_per_m = 0.0;  // sigma2, N s/m per N; not of the cone
  // g(v) = Fc + (Fs - Fc) exp(-(v/vs)^alpha)
  double stribeck_velocity_m_per_s = 1e-3;  // vs > 0
  double stribeck_exponent = 2.0;           // alpha > 0
  // sigma0. Of the first four kinds it is the spring they stick by, and 0 means rigid. > 0 for the
  // last three.
  double stiffness_N_per_m = 0.0;
  // sigma1, N s/m per N; not of cone and dahl. coulomb_viscous, stribeck and karnopp have it while
  // they stick, so that a mass that stops does not ring on their spring.
  double damping_s_per_m = 0.0;
  // v_d: sigma1 fades as exp(-(v/v_d)^2); 0 means that it does not.
  double damping_fade_m_per_s = 0.0;
  double stick_velocity_m_per_s = 1e-3;  // karnopp: below it a slip ends; > 0
  double elastic_fraction = 0.7;         // elasto_plastic: z_ba sigma0 / Fc, in (0, 1)
};

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

// Returns true if every number is finite and within the bounds above.
bool valid(const FrictionParameters& parameters);

// The state of a model. FrictionMemory{} is its initial value: a new contact starts without force,
// so that it cannot kick.
template <typename Vector>
struct FrictionMemory {
  Vector elastic_force_N = zero_tangent<Vector>();  // sigma0 z
  bool slipping = false;
  bool left_band = false;  // of karnopp: the slip has been faster than stick_velocity_m_per_s
};

template <typename Vector>
struct FrictionForce {
  Vector force_N = zero_tangent<Vector>();  // at the tick's end
  // Over the tick: times the displacement it is the work of the tick, to rounding. The audit of
  // energy pairs these two. (Held over the next tick, as a device does, a force works otherwise:
  // see sampled_device.h.)
  Vector mean_force_N = zero_tangent<Vector>();
  Vector bristle_m = zero_tangent<Vector>();  // z at the tick's end; zero if rigid
  bool slipping = false;  // of the last three kinds: more than half of the motion was slip
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
