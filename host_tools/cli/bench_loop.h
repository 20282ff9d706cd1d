// `tactus bench --loop`: how late a loop wakes on this machine.
#pragma once

#include <string>

#include "host_tools/benchmark/jitter.h"

namespace tactus::host {

struct LoopBenchOptions {
  JitterPlan plan;
  std::string figure;  // PNG; empty: none
  bool json = false;
};

// Prints; throws InputError.
void bench_loop(const LoopBenchOptions& options);

}  // namespace tactus::host
