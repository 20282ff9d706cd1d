// Searches for the stiffest wall that a contact holds, by doubling and bisection. z_width.h calls
// it from several threads, each with its own trial.
#pragma once

#include <span>

#include "host_tools/certify/wall_contact.h"

namespace tactus::host {

// The stiffnesses that are searched. A search begins at the softest; if that does not hold, at the
// faintest.
inline constexpr double kSoftestWall_N_per_m = 100.0;
inline constexpr double kFaintestWall_N_per_m = 1.0;
inline constexpr double kStiffestWall_N_per_m = 51'200.0;

// The result for several contacts.
struct StableStiffness {
  // 0 if not even the faintest wall is stable.
  double stiffness_N_per_m = 0.0;
  // The index of the contact that limits it.
  std::size_t worst = 0;
};

// Returns the largest stiffness, at most kStiffestWall_N_per_m, for which all contacts are stable,
// to the relative `precision`. Each contact is tried from soft to stiff in steps of two, so that an
// island of stability above an unstable stiffness does not count; bisection then narrows the first
// failure down.
StableStiffness stiffest_stable(ContactTrial& trial, std::span<const WallContact> contacts,
                                double damping_Ns_per_m, double precision);

// Returns the largest damping, N s/m, with which all contacts hold the softest wall or else the
// faintest, to within 5 %; 0 if there is none.
double largest_stable_damping(ContactTrial& trial, std::span<const WallContact> contacts);

}  // namespace tactus::host
