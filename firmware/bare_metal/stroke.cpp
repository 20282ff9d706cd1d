#include "firmware/bare_metal/stroke.h"

#include <numbers>

#include "rendering/geometry/portable_math.h"

namespace tactus::firmware {
namespace {

// The periods of the three motions, ticks. They are primes, so that the whole repeats after their
// product.
constexpr std::uint64_t kSidePeriod = 3217;
constexpr std::uint64_t kDepthPeriod = 2003;
constexpr std::uint64_t kPressPeriod = 7919;

// The path is this far from the origin on average, and its distance changes by so much, m. The tool
// touches the ball at about 0.043.
constexpr double kMeanRadius_m = 0.0375;
constexpr double kRadiusChange_m = 0.0063;

// The largest slope of the direction from the vertical, to the side and to the user.
constexpr double kSideSlope = 0.8;
constexpr double kDepthSlope = 0.6;

double wave(std::uint64_t tick, std::uint64_t period) {
  const auto turn = static_cast<double>(tick % period) / static_cast<double>(period);
  return rendering::sine_cosine(2.0 * std::numbers::pi * turn).sine;
}

}  // namespace

Vec3 stroke_W(std::uint64_t tick) {
  const Vec3 direction(kSideSlope * wave(tick, kSidePeriod), 1.0,
                       kDepthSlope * wave(tick, kDepthPeriod));
  const double radius_m = kMeanRadius_m + kRadiusChange_m * wave(tick, kPressPeriod);
  return direction * (radius_m / direction.norm());
}

}  // namespace tactus::firmware
