// Elementary functions whose bits depend only on IEEE 754 arithmetic. The C library picks other
// code paths, and so other last bits, by processor; a simulation that feeds its results back would
// then diverge from one machine to the next.
#pragma once

namespace tactus::host {

// e^x for x <= 0, relative error below 4e-16; 0 below -700, where the simulation has no use for the
// difference.
double exp_nonpositive(double x);

struct SinCos {
  double sin;
  double cos;
};

// For |x| <= 1e4 rad, absolute error below 1e-15 plus the rounding of x.
SinCos sin_cos(double x);

}  // namespace tactus::host
