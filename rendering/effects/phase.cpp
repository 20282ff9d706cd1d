#include "rendering/effects/phase.h"

#include <cmath>

#include "rendering/geometry/portable_math.h"

namespace tactus::rendering {
namespace {

constexpr int kQuarterBits = 62;
constexpr Phase kQuarter = Phase{1} << kQuarterBits;

}  // namespace

Phase phase_of_turns(double turns) {
  constexpr double kWholeTurn = 0x1p64;
  const double part = turns - std::floor(turns);  // 1 where a tiny negative number is rounded
  return part < 1.0 ? static_cast<Phase>(part * kWholeTurn) : 0;
}

double sine(Phase phase) {
  constexpr double kRadiansPerUnit = 0x1.921fb54442d18p-62;  // pi/2 over 2^62
  const auto quarter = phase >> kQuarterBits;
  const Phase within = phase & (kQuarter - 1);
  const bool falling = (quarter & 1U) != 0;
  const double r = static_cast<double>(falling ? kQuarter - within : within) * kRadiansPerUnit;
  const double magnitude = sine_cosine(r).sine;
  return quarter < 2 ? magnitude : -magnitude;
}

}  // namespace tactus::rendering
