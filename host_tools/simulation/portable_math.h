// The exponential function for the plant, where rendering/geometry/portable_math.h has the general
// one: inline, and for arguments that are not positive.
#pragma once

#include <bit>
#include <cstdint>

namespace tactus::host {

// e^x for x <= 0, relative error below 5e-16; 0 below -700, where the simulation has no use for the
// difference. Inline: the plant needs it six times a sub-step.
inline double exp_nonpositive(double x) {
  if (!(x > -700.0)) {
    return 0.0;
  }
  constexpr double kLog2OfE = 0x1.71547652b82fep+0;
  constexpr double kLn2High = 0x1.62e42fee00000p-1;  // 33 bits: exact times an integer below 2^20
  constexpr double kLn2Low = 0x1.a39ef35793c76p-33;
  const int exponent = static_cast<int>(x * kLog2OfE - 0.5);
  const auto n = static_cast<double>(exponent);
  const double r = (x - n * kLn2High) - n * kLn2Low;
  // Taylor on |r| <= ln(2)/2, remainder r^13/13! = 1.7e-16; even and odd powers as two independent
  // chains, which halves the time to wait for them.
  const double s = r * r;
  const double even =
      1.0 + s * (1.0 / 2.0 +
                 s * (1.0 / 24.0 +
                      s * (1.0 / 720.0 +
                           s * (1.0 / 40320.0 + s * (1.0 / 3628800.0 + s * (1.0 / 479001600.0))))));
  const double odd =
      1.0 +
      s * (1.0 / 6.0 +
           s * (1.0 / 120.0 + s * (1.0 / 5040.0 + s * (1.0 / 362880.0 + s * (1.0 / 39916800.0)))));
  constexpr std::uint64_t kMantissaBits = 52;
  constexpr int kBias = 1023;
  const auto scale =
      std::bit_cast<double>(static_cast<std::uint64_t>(exponent + kBias) << kMantissaBits);
  return scale * (even + r * odd);
}

}  // namespace tactus::host
