// The search for the point that fits a record best: where it starts and how it goes on.
#pragma once

#include <span>
#include <vector>

#include "host_tools/friction/fit.h"
#include "host_tools/friction/fit_space.h"
#include "host_tools/friction/least_squares.h"

namespace tactus::host {

struct Solution {
  FitPoint point;
  LeastSquares squares;  // of the steps from where the search began, in the order of the free
};

// Returns the least sum of squares near `start`.
Solution solve(const FitPoint& start, const FrictionRecord& record);

// Points from which a search should find the least of all, one at least. All quantities of the
// kind are free in them.
std::vector<FitPoint> starts_of(const FrictionRecord& record, const RecordTraits& traits,
                                rendering::FrictionKind kind, const FitOptions& options);

// A bristle with which presliding is over within a tenth of the shortest steps of the record.
double stiffest(const FitPoint& point, const RecordTraits& traits);

// Returns the best solution. It takes a few steps from each start, and from two more with a
// smaller and a larger Stribeck velocity, and goes on from the best to the end, under both meanings
// of a row.
Solution best_solution(std::span<const FitPoint> starts, const FrictionRecord& record);

}  // namespace tactus::host
