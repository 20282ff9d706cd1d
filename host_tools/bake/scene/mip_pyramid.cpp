// Each level is the level before it, resampled to half its size, along rows and then along columns.
#include "host_tools/bake/scene/mip_pyramid.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "rendering/effects/phase.h"

namespace tactus::host {
namespace {

using rendering::TextureFormat;
using rendering::TextureSize;

// The filter is a sinc under a Hann window, along rows and then along columns. It reaches kReach
// new texels to each side and cuts at kCut waves a new texel. Its gain is 1.00 at 1/5, 0.95 at 1/4
// and below 0.007 from 1/2 on. The mean of four texels would let 64 % of the wave of two new texels
// pass, which is the first one to alias.
constexpr double kReach = 6.0;
constexpr double kCut = 0.35;

// Returns the sine of x turns by the controller's own function: that of the C library may differ in
// the last bit from one machine to the next.
double sine_of_turns(double x) {
  return rendering::sine(rendering::phase_of_turns(x));
}

// Returns the filter's weight at a distance of x new texels.
double kernel(double x) {
  const double wave = 2.0 * kCut * x;
  const double sinc = x == 0.0 ? 1.0 : sine_of_turns(0.5 * wave) / (std::numbers::pi * wave);
  return sinc * (0.5 + 0.5 * sine_of_turns(0.25 + 0.5 * x / kReach));
}

// An old texel's contribution to a new one.
struct Tap {
  std::uint32_t from;
  float weight;
};

// Returns the old texels that contribute to the new texel `to`, with weights that sum to 1. Indices
// wrap around, since the picture repeats.
std::vector<Tap> taps_of(std::uint32_t to, std::uint32_t old_count, std::uint32_t new_count) {
  const double ratio = static_cast<double>(old_count) / new_count;
  const double centre = (to + 0.5) * ratio - 0.5;
  const auto first = static_cast<std::int64_t>(std::ceil(centre - kReach * ratio));
  const auto last = static_cast<std::int64_t>(std::floor(centre + kReach * ratio));
  const auto weight = [&](std::int64_t i) {
    return kernel((static_cast<double>(i) - centre) / ratio);
  };
  double sum = 0.0;
  for (std::int64_t i = first; i <= last; ++i) {
    sum += weight(i);
  }
  const std::int64_t count = old_count;
  std::vector<Tap> taps;
  for (std::int64_t i = first; i <= last; ++i) {
    taps.push_back({static_cast<std::uint32_t>((i % count + count) % count),
                    static_cast<float>(weight(i) / sum)});
  }
  return taps;
}

// One level, row by row, not rounded to bytes: rounding once a level would add up.
struct Plane {
  TextureSize size;
  std::size_t channels = 1;
  std::vector<float> values;
};

// Returns the level resampled to another width.
Plane narrowed(const Plane& old, std::uint32_t width) {
  Plane result{{width, old.size.height}, old.channels, {}};
  result.values.resize(std::size_t{width} * old.size.height * old.channels);
  std::vector<std::vector<Tap>> taps;
  taps.reserve(width);
  for (std::uint32_t x = 0; x < width; ++x) {
    taps.push_back(taps_of(x, old.size.width, width));
  }
  float* to = result.values.data();
  for (std::size_t y = 0; y < old.size.height; ++y) {
    const float* row = &old.values[y * old.size.width * old.channels];
    for (const std::vector<Tap>& of_texel : taps) {
      for (const Tap& tap : of_texel) {
        for (std::size_t c = 0; c < old.channels; ++c) {
          to[c] += tap.weight * row[tap.from * old.channels + c];
        }
      }
      to += old.channels;
    }
  }
  return result;
}

// Returns the level resampled to another height.
Plane lowered(const Plane& old, std::uint32_t height) {
  const std::size_t line = old.size.width * old.channels;
  Plane result{{old.size.width, height}, old.channels, {}};
  result.values.resize(line * height);
  for (std::uint32_t y = 0; y < height; ++y) {
    float* to = &result.values[y * line];
    for (const Tap& tap : taps_of(y, old.size.height, height)) {
      const float* from = &old.values[tap.from * line];
      for (std::size_t i = 0; i < line; ++i) {
        to[i] += tap.weight * from[i];
      }
    }
  }
  return result;
}

// Appends the level as bytes. The filter has negative weights, so values may lie beyond black and
// white and are cut off.
void append(const Plane& plane, std::vector<std::uint8_t>& bytes) {
  constexpr float kWhite = 255.0F;
  for (const float value : plane.values) {
    bytes.push_back(static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0F, kWhite))));
  }
}

}  // namespace

std::vector<std::uint8_t> build_mip_pyramid(std::span<const std::uint8_t> texels, TextureSize size,
                                            TextureFormat format) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(rendering::pyramid_bytes(size, format));
  Plane plane{size, static_cast<std::size_t>(format), {texels.begin(), texels.end()}};
  append(plane, bytes);
  while (plane.size != TextureSize{}) {
    const TextureSize next = rendering::coarser(plane.size);
    if (next.width != plane.size.width) {
      plane = narrowed(plane, next.width);
    }
    if (next.height != plane.size.height) {
      plane = lowered(plane, next.height);
    }
    append(plane, bytes);
  }
  return bytes;
}

}  // namespace tactus::host
