// The stiffest wall that a contact holds, by bisection.
#pragma once

#include <span>

#include "host_tools/certify/wall_contact.h"

namespace tactus::host {

// The stiffnesses that are looked at, N/m.
inline constexpr double kSoftestWall_N_per_m = 100.0;
inline constexpr double kFaintestWall_N_per_m = 1.0;  // where the softest does not hold
inline constexpr double kStiffestWall_N_per_m = 51'200.0;

struct StableStiffness {
  double stiffness_N_per_m = 0.0;  // 0: not even the faintest wall
  std::size_t worst = 0;           // the contact that limits it
};

// The largest K for which all of the contacts are stable, to the relative precision. Each is looked
// at from soft to stiff in steps of two, so that an island of stability above an unstable stiffness
// does not count; then between the last good and the first bad one. At most kStiffestWall_N_per_m.
StableStiffness stiffest_stable(ContactTrial& trial, std::span<const WallContact> contacts,
                                double damping_Ns_per_m, double precision);

// The largest B for which all of them hold the softest wall, or else the faintest, to within five
// percent; 0 if none.
double largest_stable_damping(ContactTrial& trial, std::span<const WallContact> contacts);

}  // namespace tactus::host
