// The experiments in which the motion is given: frictional lag and hysteresis. experiments.cpp
// lists them.
#pragma once

#include "host_tools/friction/experiments.h"

namespace tactus::host {

// Frictional lag: the velocity is mean (1 + swing sin(omega t)) for each omega, and the second
// period is kept. A sample belongs to the middle of a tick and has the tick's mean force. The
// further column is omega_rad_per_s.
Setup lag_setup();
ExperimentResult run_lag(const ExperimentRun& run);

// Hysteresis: x = A sin(2 pi f t) for each amplitude A, and the last cycle is kept. The further
// column is amplitude_m.
Setup hysteresis_setup();
ExperimentResult run_hysteresis(const ExperimentRun& run);

}  // namespace tactus::host
