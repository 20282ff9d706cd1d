// Elementary functions whose bits depend on IEEE 754 arithmetic alone. The C library picks other
// code paths, and so other last bits, by version and processor, which would break the replay of a
// recorded tick.
#pragma once

namespace tactus::rendering {

// The sine and the cosine of one angle.
struct SineCosine {
  double sine = 0.0;
  double cosine = 1.0;
};

// Returns sine and cosine of x (rad), within 4e-16 of the true values for |x| <= kLargestAngle; NaN
// for a larger or a non-finite one.
SineCosine sine_cosine(double x);
inline constexpr double kLargestAngle = 1.0e6;

// Returns e^x with a relative error below 1e-15 for |x| <= kLargestExponent. Beyond, x is taken as
// that limit, so that the result is finite and above zero; NaN stays NaN.
double exponential(double x);
inline constexpr double kLargestExponent = 700.0;

// Returns the natural logarithm, with a relative error below 1e-15 plus 1e-16 absolute. At or below
// kSmallestLogarithmArgument it is the value there, about -708; NaN stays NaN, infinity infinity.
double logarithm(double x);
inline constexpr double kSmallestLogarithmArgument = 0x1p-1022;

// Returns the cube root, with a relative error below 1e-15, for kSmallestCube <= x <= kLargestCube;
// 0 for any other x, also NaN.
double cube_root(double x);
inline constexpr double kSmallestCube = 0x1p-1020;
inline constexpr double kLargestCube = 0x1p+1000;

}  // namespace tactus::rendering
