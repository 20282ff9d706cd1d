#include "host_tools/certify/stability_search.h"

#include <algorithm>
#include <cmath>

namespace tactus::host {
namespace {

// Returns the end of the stretch in which `holds` is true, between `good`, where it is true, and
// `bad`, where it is false. The result is below the true end by at most the factor 1 + `precision`.
// The middle is the geometric mean, since stiffness matters by its ratio.
template <class Predicate>
double end_of(double good, double bad, double precision, const Predicate& holds) {
  while (bad > (1.0 + precision) * good) {
    const double middle = std::sqrt(good * bad);
    (holds(middle) ? good : bad) = middle;
  }
  return good;
}

// The values to try, in steps of a factor.
struct Range {
  double first = 0.0;
  double last = 0.0;
  double step = 2.0;
  // True if `last` is known not to hold.
  bool last_is_bad = false;
};

// Returns the end of the first stretch that holds; 0 if `first` does not hold.
template <class Predicate>
double end_of_first_stretch(const Range& range, double precision, const Predicate& holds) {
  if (!holds(range.first)) {
    return 0.0;
  }
  double good = range.first;
  while (good < range.last) {
    const double next = std::min(range.step * good, range.last);
    if ((next == range.last && range.last_is_bad) || !holds(next)) {
      return end_of(good, next, precision, holds);
    }
    good = next;
  }
  return good;
}

// Returns the stiffest wall up to `most`. A contact that does not hold the softest wall is tried
// from the faintest one on: a light device with little damping holds little by itself, and much
// more in a hand.
template <class Predicate>
double end_below(double most, bool most_is_bad, double precision, const Predicate& holds) {
  Range range{.first = kSoftestWall_N_per_m, .last = most, .last_is_bad = most_is_bad};
  if (most > range.first) {
    const double end = end_of_first_stretch(range, precision, holds);
    if (end > 0.0) {
      return end;
    }
    range.last = range.first;
    range.last_is_bad = true;
  }
  range.first = kFaintestWall_N_per_m;
  return end_of_first_stretch(range, precision, holds);
}

// Returns the largest damping with which all contacts hold a wall of that stiffness; 0 if none.
double largest_damping_of(ContactTrial& trial, std::span<const WallContact> contacts,
                          double stiffness_N_per_m) {
  constexpr double kPrecision = 0.05;
  Range range{.first = 0.1, .last = 1000.0, .step = 1.3};
  for (const WallContact& contact : contacts) {
    const auto holds = [&](double damping) {
      return is_stable(trial.run(contact, {stiffness_N_per_m, damping}));
    };
    // A contact that holds the limit of the contacts before it cannot lower it.
    if (range.last_is_bad && holds(range.last)) {
      continue;
    }
    range.last = end_of_first_stretch(range, kPrecision, holds);
    range.last_is_bad = true;
    if (range.last == 0.0) {
      break;
    }
  }
  return range.last;
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
    found = {.stiffness_N_per_m = end_below(most, i > 0, precision, holds), .worst = i};
    if (found.stiffness_N_per_m == 0.0) {
      break;
    }
  }
  return found;
}

double largest_stable_damping(ContactTrial& trial, std::span<const WallContact> contacts) {
  const double largest = largest_damping_of(trial, contacts, kSoftestWall_N_per_m);
  return largest > 0.0 ? largest : largest_damping_of(trial, contacts, kFaintestWall_N_per_m);
}

}  // namespace tactus::host
