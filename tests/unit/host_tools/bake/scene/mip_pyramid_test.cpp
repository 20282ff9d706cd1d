#include "host_tools/bake/scene/mip_pyramid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "rendering/material/texture_place.h"

namespace tactus::host {
namespace {

using rendering::TextureFormat;
using rendering::TextureSize;
using rendering::TextureView;

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kQuantum = 1.0 / 255.0;

// Waves along x, `period` texels long.
std::vector<std::uint8_t> grating(TextureSize size, double period) {
  std::vector<std::uint8_t> texels;
  for (std::uint32_t y = 0; y < size.height; ++y) {
    for (std::uint32_t x = 0; x < size.width; ++x) {
      texels.push_back(
          static_cast<std::uint8_t>(128.0 + 100.0 * std::sin(kTurn * (x + 0.5) / period)));
    }
  }
  return texels;
}

double spread(const TextureView& texture, std::size_t level) {
  double lowest = 1.0;
  double highest = 0.0;
  for (std::uint32_t y = 0; y < texture.size(level).height; ++y) {
    for (std::uint32_t x = 0; x < texture.size(level).width; ++x) {
      lowest = std::min(lowest, texture.texel(level, x, y).x());
      highest = std::max(highest, texture.texel(level, x, y).x());
    }
  }
  return highest - lowest;
}

TEST(MipPyramid, KeepsWhatIsEvenAndTheFinestLevelAsItIs) {
  const std::vector<std::uint8_t> even(1221, 77);
  for (const std::uint8_t byte : build_mip_pyramid(even, {37, 11}, TextureFormat::rgb)) {
    ASSERT_EQ(byte, 77);
  }
  const auto waves = grating({64, 4}, 8.0);
  const auto pyramid = build_mip_pyramid(waves, {64, 4}, TextureFormat::grey);
  EXPECT_EQ(pyramid.size(), rendering::pyramid_bytes({64, 4}, TextureFormat::grey));
  EXPECT_TRUE(std::ranges::equal(std::span(pyramid).first(waves.size()), waves));
}

TEST(MipPyramid, EachLevelLosesTheWavesOfTwoOfItsTexelsAndKeepsThoseOfFive) {
  for (const TextureSize size : {TextureSize{256, 8}, TextureSize{260, 7}}) {
    for (const double waves : {0.25, 0.275, 0.35}) {
      const double period = size.width / std::round(waves * size.width);  // so that it repeats
      const auto pyramid = build_mip_pyramid(grating(size, period), size, TextureFormat::grey);
      const auto texture = *TextureView::open(pyramid, size, TextureFormat::grey);
      EXPECT_LE(spread(texture, 1), 0.01 * 200.0 / 255.0 + 2.0 * kQuantum) << period;
    }
    const auto pyramid =
        build_mip_pyramid(grating(size, size.width / 26.0), size, TextureFormat::grey);
    const auto texture = *TextureView::open(pyramid, size, TextureFormat::grey);
    EXPECT_GE(spread(texture, 1), 0.9 * 200.0 / 255.0);
  }
}

// The grating of the specification: waves of 1 mm, 16 texels each, stroked along x.
class Stroke {
 public:
  Stroke()
      : bytes_(build_mip_pyramid(grating({256, 16}, 16.0), {256, 16}, TextureFormat::grey)),
        texture_(*TextureView::open(bytes_, {256, 16}, TextureFormat::grey)) {}

  // Returns the values of one second of a stroke at 1 kHz.
  [[nodiscard]] std::vector<double> run(double speed_m_per_s) const {
    constexpr double kDt_s = 1e-3;
    std::vector<double> values;
    values.reserve(1000);
    for (int i = 0; i < 1000; ++i) {
      const rendering::TexturePlace place = rendering::place_along_axis(
          {speed_m_per_s * i * kDt_s, 0.0, 0.0003}, Vec3::UnitY(), 1, kTile_m);
      values.push_back(look_up(texture_, place, speed_m_per_s * kDt_s).colour.x());
    }
    return values;
  }

 private:
  static constexpr double kTile_m = 0.016;
  std::vector<std::uint8_t> bytes_;
  TextureView texture_;
};

// Amplitude at a whole number of hertz, over one second.
double amplitude(const std::vector<double>& values, int frequency_Hz) {
  std::complex<double> sum;
  const auto count = static_cast<double>(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    sum += values[i] * std::polar(1.0, -kTurn * frequency_Hz * static_cast<double>(i) / count);
  }
  return 2.0 * std::abs(sum) / count;
}

TEST(MipPyramid, AOneMillimetreGratingStrokedAt50MillimetresASecondGives50Hz) {
  const std::vector<double> values = Stroke().run(0.05);
  EXPECT_GT(amplitude(values, 50), 0.9 * 100.0 / 255.0);
  for (int frequency = 1; frequency < 500; ++frequency) {
    if (frequency % 50 != 0) {
      ASSERT_LT(amplitude(values, frequency), kQuantum) << frequency;
    }
  }
}

TEST(MipPyramid, AGratingAboveTheNyquistFrequencyIsNotFeltAtAll) {
  const Stroke stroke;
  for (const double speed : {0.501, 0.55, 0.6, 0.75, 0.95, 0.999, 1.001, 1.5, 2.003, 5.0}) {
    const std::vector<double> values = stroke.run(speed);
    for (int frequency = 1; frequency < 500; ++frequency) {
      ASSERT_LT(amplitude(values, frequency), kQuantum) << speed << " m/s, " << frequency << " Hz";
    }
  }
}

// Below the Nyquist frequency the wave may fade, but nothing else may sound in its place. What is
// heard beside it is the straight lines of the interpolation.
TEST(MipPyramid, BelowTheNyquistFrequencyOnlyTheWaveItselfIsFelt) {
  const double loudest = 0.06 * 100.0 / 255.0;
  const Stroke stroke;
  for (const int hertz : {10, 100, 170, 230, 310, 390, 450, 490}) {
    const std::vector<double> values = stroke.run(hertz * 1e-3);
    for (int frequency = 1; frequency < 500; ++frequency) {
      if (frequency != hertz) {
        ASSERT_LT(amplitude(values, frequency), loudest) << hertz << " Hz, heard at " << frequency;
      }
    }
  }
  EXPECT_GT(amplitude(stroke.run(0.1), 100), 0.8 * 100.0 / 255.0);
}

}  // namespace
}  // namespace tactus::host
