// The figures of the table of `tactus compare`: what one run did, and how far it is from another.
#pragma once

#include <cstddef>

#include "host_tools/compare/compared_run.h"

namespace tactus::host {

// A span of time in which ticks count, s.
struct TimeSpan {
  double from_s;
  double to_s;

  [[nodiscard]] bool holds(double t_s) const { return t_s >= from_s && t_s <= to_s; }
};

// The figures of a run within a span of time.
struct RunFigures {
  std::size_t contact_ticks = 0;
  // The times that a tick in contact was followed by one without.
  std::size_t breaks = 0;
  double largest_force_N = 0.0;
  // The largest change of the force from one tick to the next.
  double largest_jump_N = 0.0;
  // The root mean square, over the ticks in contact, of half the second difference of the force: of
  // a force that alternates between two values their difference.
  double ripple_N = 0.0;
  // The work on the hand along the path; the force is linear from tick to tick.
  double given_out_J = 0.0;
  // The straight moves, segments or Newton's steps of a tick: the mean over the ticks in contact,
  // and the most.
  double mean_moves = 0.0;
  std::size_t most_moves = 0;
  // The proxy's largest distance from the surface on its two sides, >= 0 (ComparedTick::height_m).
  double above_m = 0.0;
  double below_m = 0.0;
  // The largest distance of the proxy, and difference of the force, from the other run at the same
  // time.
  double off_m = 0.0;
  double force_off_N = 0.0;
};

// Returns the figures of a run against another one, which may have another rate: between its ticks
// it is linear.
RunFigures figures_of(const ComparedRun& run, const ComparedRun& other, const TimeSpan& span);

// Returns the distance of the run's proxy from the other's at one of its ticks, m.
double distance_from(const ComparedTick& tick, const ComparedRun& other);

}  // namespace tactus::host
