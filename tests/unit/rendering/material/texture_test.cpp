#include "rendering/material/texture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace tactus::rendering {
namespace {

// A pyramid whose coarser levels hold one value each: level k holds 10 k.
std::vector<std::uint8_t> marked_pyramid(const std::vector<std::uint8_t>& finest, TextureSize size,
                                         TextureFormat format) {
  std::vector<std::uint8_t> bytes = finest;
  std::uint8_t mark = 0;
  while (size != TextureSize{}) {
    size = coarser(size);
    mark = static_cast<std::uint8_t>(mark + 10);
    bytes.insert(bytes.end(), static_cast<std::size_t>(format) * size.width * size.height, mark);
  }
  return bytes;
}

TextureView open(const std::vector<std::uint8_t>& bytes, TextureSize size,
                 TextureFormat format = TextureFormat::grey) {
  const auto view = TextureView::open(bytes, size, format);
  EXPECT_TRUE(view.has_value());
  return *view;
}

TEST(Texture, OpensAnySizeThatHasItsBytes) {
  EXPECT_EQ(pyramid_bytes({4, 4}, TextureFormat::grey), 21U);
  EXPECT_EQ(pyramid_bytes({5, 1}, TextureFormat::rgb), 24U);  // 5, 2, 1
  const std::vector<std::uint8_t> bytes(pyramid_bytes({7, 3}, TextureFormat::grey));
  EXPECT_EQ(open(bytes, {7, 3}).levels(), 3U);
  EXPECT_EQ(open(bytes, {7, 3}).size(1), (TextureSize{3, 1}));
  EXPECT_FALSE(TextureView::open(bytes, {3, 7}, TextureFormat::rgb));
  EXPECT_FALSE(TextureView::open(std::span(bytes).first(21), {7, 3}, TextureFormat::grey));
  EXPECT_FALSE(TextureView::open({}, {0, 3}, TextureFormat::grey));
  EXPECT_FALSE(TextureView::open(bytes, {kMaxTextureSide + 1, 1}, TextureFormat::grey));
  EXPECT_FALSE(TextureView::open(bytes, {7, 3}, static_cast<TextureFormat>(2)));
  const std::vector<std::uint8_t> large(pyramid_bytes({kMaxTextureSide, 1}, TextureFormat::grey));
  EXPECT_EQ(open(large, {kMaxTextureSide, 1}).levels(), kMaxTextureLevels);
}

TEST(Texture, StandsUprightAndRepeats) {
  // Upper row 0 51, lower row 102 153.
  const auto bytes = marked_pyramid({0, 51, 102, 153}, {2, 2}, TextureFormat::grey);
  const TextureView texture = open(bytes, {2, 2});
  for (const double shift : {-3.0, 0.0, 5.0}) {
    EXPECT_NEAR(look_up(texture, TexturePoint{0.25 + shift, 0.75}, 0.0).x(), 0.0, 1e-12);
    EXPECT_NEAR(look_up(texture, TexturePoint{0.75, 0.75 + shift}, 0.0).x(), 0.2, 1e-12);
    EXPECT_NEAR(look_up(texture, TexturePoint{0.25 + shift, 0.25}, 0.0).x(), 0.4, 1e-12);
    EXPECT_NEAR(look_up(texture, TexturePoint{0.75, 0.25 + shift}, 0.0).x(), 0.6, 1e-12);
    EXPECT_NEAR(look_up(texture, TexturePoint{shift, shift}, 0.0).x(), 0.3, 1e-12)
        << "mean across the seam";
  }
}

TEST(Texture, BilinearLookupAndSlopeAreExactOnARamp) {
  constexpr std::uint64_t kSeed = 111;
  std::mt19937_64 random(kSeed);
  std::uniform_real_distribution<double> inside(0.1, 0.9);
  // 16 x 16 texels of 3 x + 5 (15 - y).
  std::vector<std::uint8_t> finest;
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) {
      finest.push_back(static_cast<std::uint8_t>(3 * x + 5 * (15 - y)));
    }
  }
  const auto bytes = marked_pyramid(finest, {16, 16}, TextureFormat::grey);
  const TextureView texture = open(bytes, {16, 16});
  for (int i = 0; i < 1000; ++i) {
    const TexturePoint at{inside(random), inside(random)};
    const double expected = (3.0 * (16.0 * at.u - 0.5) + 5.0 * (16.0 * at.v - 0.5)) / 255.0;
    ASSERT_NEAR(look_up(texture, at, 0.0).x(), expected, 1e-12) << "seed 111, case " << i;
    const TextureSlope rise = slope(texture, at, 0.0);
    ASSERT_NEAR(rise.per_u, 48.0 / 255.0, 1e-10) << "seed 111, case " << i;
    ASSERT_NEAR(rise.per_v, 80.0 / 255.0, 1e-10) << "seed 111, case " << i;
  }
}

TEST(Texture, BlendsBetweenLevelsAndStopsAtTheLast) {
  const auto bytes = marked_pyramid(std::vector<std::uint8_t>(192, 0), {8, 8}, TextureFormat::rgb);
  const TextureView texture = open(bytes, {8, 8}, TextureFormat::rgb);
  for (const double level : {0.0, 0.25, 1.0, 1.7, 3.0}) {
    EXPECT_NEAR(look_up(texture, TexturePoint{0.3, 0.3}, level).z(), 10.0 * level / 255.0, 1e-12);
  }
  EXPECT_NEAR(look_up(texture, TexturePoint{0.3, 0.3}, 9.0).y(), 30.0 / 255.0, 1e-12);
  EXPECT_EQ(look_up(texture, TexturePoint{0.3, 0.3}, -2.0).x(), 0.0);
}

TEST(Texture, TheLevelsTexelIsNeverSmallerThanATicksTravel) {
  const std::vector<std::uint8_t> bytes(pyramid_bytes({1024, 1024}, TextureFormat::grey));
  const TextureView texture = open(bytes, {1024, 1024});
  constexpr double kTexel_m = 1e-4;
  double before = 0.0;
  for (double travel = 1e-6; travel < 0.04; travel *= 1.01) {
    const double level = mip_level(texture, travel, kTexel_m);
    EXPECT_GE(kTexel_m * std::exp2(std::floor(level)), std::min(travel, 0.05));
    EXPECT_LE(std::abs(level - std::max(0.0, std::log2(2.0 * travel / kTexel_m))), 0.087);
    EXPECT_GE(level, before);
    before = level;
  }
  EXPECT_EQ(mip_level(texture, 0.0, kTexel_m), 0.0);
  EXPECT_EQ(mip_level(texture, 10.0, kTexel_m), 10.0);
}

TEST(Texture, IsContinuousEverywhere) {
  constexpr std::uint64_t kSeed = 113;
  std::mt19937_64 random(kSeed);
  std::uniform_int_distribution<int> grey(0, 255);
  std::vector<std::uint8_t> bytes(pyramid_bytes({5, 3}, TextureFormat::grey));
  for (std::uint8_t& byte : bytes) {
    byte = static_cast<std::uint8_t>(grey(random));
  }
  const TextureView texture = open(bytes, {5, 3});
  double value = look_up(texture, TexturePoint{-1.0, -0.5}, 0.0).x();
  double rise = slope(texture, {-1.0, -0.5}, 0.0).per_u;
  for (int i = 1; i < 200'000; ++i) {
    const double t = i * 1e-5;
    const TexturePoint at{-1.0 + 1.3 * t, -0.5 + t};
    const double level = 0.9 * t;
    const double next_value = look_up(texture, at, level).x();
    const double next_rise = slope(texture, at, level).per_u;
    ASSERT_LT(std::abs(next_value - value), 3e-4) << "seed 113, at " << t;
    ASSERT_LT(std::abs(next_rise - rise), 3e-3) << "seed 113, at " << t;
    value = next_value;
    rise = next_rise;
  }
}

}  // namespace
}  // namespace tactus::rendering
