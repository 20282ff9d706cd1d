// The experiments in which a mass finds its own motion: presliding, break-away, stick-slip and
// hunting. experiments.cpp lists them.
#pragma once

#include "host_tools/friction/experiments.h"

namespace tactus::host {

// Presliding: the force ramps and holds between plus and minus a share of what holds the mass, as
// slowly as in the solution of tests/reference. The further column is push_N.
Setup presliding_setup();
ExperimentResult run_presliding(const ExperimentRun& run);

// Break-away: one sample for each rate of the force, at the moment of break-away. That is the first
// maximum of the friction force, or else the moment at which the mass has the speed
// sliding_m_per_s. The further columns are rate_N_per_s and is_maximum (1 or 0).
Setup break_away_setup();
ExperimentResult run_break_away(const ExperimentRun& run);

// Stick-slip: a spring whose end moves steadily pulls the mass. A slip lasts from one passage of
// slipping_m_per_s to the next; each gives a row. The further columns are spring_end_m and
// spring_N.
Setup stick_slip_setup();
ExperimentResult run_stick_slip(const ExperimentRun& run);

// Hunting: a controller u = -Kp (x - target) - Ki (integral of that) - Kv v, sampled and held at
// the rate. One row about the cycles of the second half. The further columns are target_m and
// control_N.
Setup hunting_setup();
ExperimentResult run_hunting(const ExperimentRun& run);

}  // namespace tactus::host
