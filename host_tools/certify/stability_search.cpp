#include "host_tools/certify/stability_search.h"

#include <algorithm>
#include <cmath>

namespace tactus::host {
namespace {

// Where `holds` ends between `good`, at which it does, and `bad`, at which it does not.
template <class Predicate>
double end_of(double good, double bad, double precision, const Predicate& holds) {
  while (bad > (1.0 + precision) * good) {
    const double middle = std::sqrt(good * bad);
    (holds(middle) ? good : bad) = middle;
  }
  return good;
}

// Steps of two from `first`: the end of the first stretch that holds, or 0. `last` is the most that
// is looked at, and `is_known_bad` says that it does not hold.
template <class Predicate>
double end_of_first_stretch(double first, double last, bool is_known_bad, double precision,
                            const Predicate& holds) {
  constexpr double kStep = 2.0;
  if (!holds(first)) {
    return 0.0;
  }
  double good = first;
  while (good < last) {
    const double next = std::min(kStep * good, last);
    if ((next == last && is_known_bad) || !holds(next)) {
      return end_of(good, next, precision, holds);
    }
    good = next;
  }
  return good;
}

}  // namespace

StableStiffness stiffest_stable(ContactTrial& trial, std::span<const WallContact> contacts,
                                double damping_Ns_per_m, double precision) {
  StableStiffness found{.stiffness_N_per_m = kStiffestWall_N_per_m};
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const auto holds = [&](double stiffness) {
      return is_stable(trial.run(contacts[i], {stiffness, damping_Ns_per_m}));
    };
    const double most = found.stiffness_N_per_m;
    if (i > 0 && holds(most)) {
      continue;
    }
    found = {.stiffness_N_per_m =
                 end_of_first_stretch(kSoftestWall_N_per_m, most, i > 0, precision, holds),
             .worst = i};
    if (found.stiffness_N_per_m == 0.0) {
      break;
    }
  }
  return found;
}

double largest_stable_damping(ContactTrial& trial, std::span<const WallContact> contacts) {
  constexpr double kLeast_Ns_per_m = 0.01;
  constexpr double kMost_Ns_per_m = 1000.0;
  constexpr double kPrecision = 0.05;
  double most = kMost_Ns_per_m;
  for (const WallContact& contact : contacts) {
    const auto holds = [&](double damping) {
      return is_stable(trial.run(contact, {kSoftestWall_N_per_m, damping}));
    };
    if (most < kMost_Ns_per_m && holds(most)) {
      continue;
    }
    most = end_of_first_stretch(kLeast_Ns_per_m, most, most < kMost_Ns_per_m, kPrecision, holds);
    if (most == 0.0) {
      break;
    }
  }
  return most;
}

}  // namespace tactus::host
