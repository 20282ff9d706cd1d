// `tactus bench touch --against FOLDER`: this program's ticks beside those of another build.
#pragma once

#include "host_tools/benchmark/comparison.h"

namespace tactus::host {

// Runs the comparison with a line of progress for each run, and prints a line for each row: the
// times of both, and the ratio of this program's to the other's.
void bench_comparison(Comparison comparison, bool json);

}  // namespace tactus::host
