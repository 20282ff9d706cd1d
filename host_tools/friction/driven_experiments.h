// The experiments in which the motion is given: frictional lag and hysteresis.
#pragma once

#include "host_tools/friction/experiments.h"

namespace tactus::host {

// v = mean (1 + swing sin(omega t)), for each omega. The second period is kept. The samples are of
// the middles of the ticks, with the mean force of the tick; column omega_rad_per_s.
Setup lag_setup();
ExperimentResult run_lag(const ExperimentRun& run);

// x = A sin(2 pi f t), for each A. The last of the cycles is kept; column amplitude_m.
Setup hysteresis_setup();
ExperimentResult run_hysteresis(const ExperimentRun& run);

}  // namespace tactus::host
