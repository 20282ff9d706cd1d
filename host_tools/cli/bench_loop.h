// `tactus bench --loop`: how late a loop wakes on this machine.
#pragma once

#include <string>

#include "host_tools/benchmark/jitter.h"

namespace tactus::host {

// The measurement, and the form in which it is shown.
struct LoopBenchOptions {
  JitterPlan plan;
  // The picture of the histogram; empty: none.
  std::string figure;
  bool json = false;
};

// Measures and prints. Throws InputError if cyclictest fails or the figure cannot be drawn.
void bench_loop(const LoopBenchOptions& options);

}  // namespace tactus::host
