// Writes the measurements of LoopTiming for people and for plots. Call after the loop; not real
// time.
#pragma once

#include <cstdio>

#include "firmware/linux/realtime/loop_timing.h"

namespace tactus::firmware {

// Prints one line with the numbers of ticks, then a table with a row for each duration: minimum,
// mean, 50th, 99th and 99.9th percentile and maximum in us. A percentile is its bin's upper edge.
void print_timing(std::FILE* file, const LoopTiming& timing);

// Writes a CSV file with a row for each bin: time_us, the bin's lower edge, and the counts of each
// duration. Rows in which all counts are zero are left out. The last row, with time_us = kTimeBins,
// counts everything longer. Returns 0 or errno.
[[nodiscard]] int write_histogram(const char* path, const LoopTiming& timing);

}  // namespace tactus::firmware
