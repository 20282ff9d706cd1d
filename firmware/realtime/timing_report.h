// What LoopTiming has counted, for people and for plots. After the loop; not real time.
#pragma once

#include <cstdio>

#include "firmware/realtime/loop_timing.h"

namespace tactus::firmware {

// One line for the ticks, then a table: a row for what was timed, its minimum, mean, 50th, 99th and
// 99.9th percentile and maximum in us. A percentile is its bin's upper edge.
void print_timing(std::FILE* file, const LoopTiming& timing);

// CSV: time_us, the lower edge of a bin, and a column of counts for everything that was timed. Bins
// in which every count is zero are left out; the last row, whose time_us is kTimeBins, counts all
// that is longer. 0, or errno.
[[nodiscard]] int write_histogram(const char* path, const LoopTiming& timing);

}  // namespace tactus::firmware
