// The experiments in which a mass finds its own motion: presliding, break-away, stick-slip,
// hunting.
#pragma once

#include "host_tools/friction/experiments.h"

namespace tactus::host {

// Ramps and holds of the force between plus and minus a share of what holds the mass, as slow as
// the solution that stands in tests/reference; column push_N.
Setup presliding_setup();
ExperimentResult run_presliding(const ExperimentRun& run);

// Returns one sample for every rate, the moment of break-away: the first maximum of the friction
// force, or if there is none, the moment at which the mass has the speed `sliding_m_per_s`. Columns
// rate_N_per_s, and is_maximum (1 or 0).
Setup break_away_setup();
ExperimentResult run_break_away(const ExperimentRun& run);

// Columns spring_end_m and spring_N. A slip is from one passage of `slipping_m_per_s` to the next;
// a row a slip.
Setup stick_slip_setup();
ExperimentResult run_stick_slip(const ExperimentRun& run);

// u = -Kp (x - target) - Ki (its integral) - Kv v, sampled and held at the rate; columns target_m
// and control_N. One row: of the cycles of the second half.
Setup hunting_setup();
ExperimentResult run_hunting(const ExperimentRun& run);

}  // namespace tactus::host
