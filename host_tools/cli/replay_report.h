// Prints the findings of `tactus replay`, in words or as JSON.
#pragma once

#include <cstddef>

#include "host_tools/replay/replay.h"
#include "host_tools/replay/what_if.h"

namespace tactus::host {

// A replay that has compared a tick or more.
struct ComparedRun {
  const ReplayResult& result;
  double rate_hz = 0.0;
  std::size_t devices = 1;
};

// Prints how many ticks were equal, and the first that differs.
void print_replay(const ComparedRun& run, bool as_json);

// Prints the recorded and the changed force side by side.
void print_change(const WhatIfSummary& summary, bool as_json);

}  // namespace tactus::host
