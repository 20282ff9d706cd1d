// The search for the parameters that fit a record best: where it starts and how it proceeds.
// fit.cpp calls it.
#pragma once

#include <span>
#include <vector>

#include "host_tools/friction/fit.h"
#include "host_tools/friction/fit_space.h"
#include "host_tools/friction/least_squares.h"

namespace tactus::host {

// The end of one search.
struct Solution {
  FitPoint point;
  // Errors and covariance of the steps from the start, in the order of the free quantities.
  LeastSquares squares;
};

// Returns the least sum of squares near `start`.
Solution solve(const FitPoint& start, const FrictionRecord& record);

// Returns points, at least one, from which a search should find the global minimum. All quantities
// of the kind are free in them.
std::vector<FitPoint> starts_of(const FrictionRecord& record, const RecordTraits& traits,
                                rendering::FrictionKind kind, const FitOptions& options);

// Returns the stiffness of a bristle with which presliding is over within a tenth of the record's
// shortest steps, N/m.
double stiffest(const FitPoint& point, const RecordTraits& traits);

// Returns the best solution. It makes a short search from each start, and from two more with a
// smaller and a larger Stribeck velocity, then a long one from the best, under both meanings of a
// row (RowTime).
Solution best_solution(std::span<const FitPoint> starts, const FrictionRecord& record);

}  // namespace tactus::host
