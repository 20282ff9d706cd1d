#include "rendering/material/texture_place.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace tactus::rendering {
namespace {

TEST(TexturePlace, OnATriangleTheCornersHaveTheirCoordinatesAndTheRestIsLinear) {
  constexpr std::uint64_t kSeed = 121;
  std::mt19937_64 random(kSeed);
  std::uniform_real_distribution<double> place(-0.1, 0.1);
  const auto point = [&] { return Vec3(place(random), place(random), place(random)); };
  for (int i = 0; i < 1000; ++i) {
    const TexturedTriangle t{
        .corners_W = {point(), point(), point()},
        .uv = {{{place(random), place(random)}, {2.0, place(random)}, {place(random), 3.0}}}};
    for (std::size_t k = 0; k < 3; ++k) {
      const TextureSpot spot = place_on_triangle(t, t.corners_W[k]).spots[0];
      ASSERT_NEAR(spot.at.u, t.uv[k].u, 1e-9) << "seed 121, case " << i;
      ASSERT_NEAR(spot.at.v, t.uv[k].v, 1e-9) << "seed 121, case " << i;
    }
    const Vec3 normal =
        (t.corners_W[1] - t.corners_W[0]).cross(t.corners_W[2] - t.corners_W[0]).normalized();
    const Vec3 middle = (t.corners_W[0] + t.corners_W[1] + t.corners_W[2]) / 3.0;
    const TextureSpot spot = place_on_triangle(t, middle + 0.01 * normal).spots[0];
    ASSERT_NEAR(spot.at.u, (t.uv[0].u + t.uv[1].u + t.uv[2].u) / 3.0, 1e-9);
    ASSERT_NEAR(spot.grad_u_W.dot(normal), 0.0, 1e-9 * spot.grad_u_W.norm());
    ASSERT_NEAR(spot.grad_u_W.dot(t.corners_W[1] - t.corners_W[0]), t.uv[1].u - t.uv[0].u, 1e-9);
  }
  const TexturedTriangle flat{.uv = {{{0.25, 0.5}, {1, 1}, {0, 1}}}};
  EXPECT_EQ(place_on_triangle(flat, {1, 2, 3}).spots[0].at.u, 0.25);
}

TEST(TexturePlace, AlongAnAxisThePictureIsUprightFromItsPositiveEnd) {
  const auto spot = [](const Vec3& p, int axis) {
    return place_along_axis(p, Vec3::Unit(axis), axis, 0.1).spots[0].at;
  };
  EXPECT_NEAR(spot({0.03, 0.02, 9}, 2).u, 0.3, 1e-12);
  EXPECT_NEAR(spot({0.03, 0.02, 9}, 2).v, 0.2, 1e-12);
  EXPECT_NEAR(spot({9, 0.02, 0.03}, 0).u, -0.3, 1e-12);  // from the right, the user is to the left
  EXPECT_NEAR(spot({9, 0.02, 0.03}, 0).v, 0.2, 1e-12);
  EXPECT_NEAR(spot({0.03, 9, 0.02}, 1).u, 0.3, 1e-12);
  EXPECT_NEAR(spot({0.03, 9, 0.02}, 1).v, -0.2, 1e-12);  // from above, the user is below
}

TEST(TexturePlace, TriplanarIsTheAxisOnAFaceThatFacesItAndBlendsInBetween) {
  const TexturePlace facing = place_triplanar({0.03, 0.02, 0.01}, Vec3::UnitY(), 0.1);
  EXPECT_EQ(facing.count, 3U);
  EXPECT_EQ(facing.spots[0].weight, 0.0);
  EXPECT_EQ(facing.spots[1].weight, 1.0);
  const TexturePlace corner = place_triplanar({0.03, 0.02, 0.01}, Vec3::Ones().normalized(), 0.1);
  EXPECT_NEAR(corner.spots[2].weight, 1.0 / 3.0, 1e-12);
}

// A ramp of 16 levels over a tile of 0.16 m: 16 / 255 in 0.01 m.
TEST(TexturePlace, SlopeOfAHeightMapBumpsTheNormal) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(512);
  for (int i = 0; i < 256; ++i) {
    bytes.push_back(static_cast<std::uint8_t>(16 * (i % 16)));
  }
  bytes.resize(pyramid_bytes({16, 16}, TextureFormat::grey));
  const TextureView texture = *TextureView::open(bytes, {16, 16}, TextureFormat::grey);
  const TexturePlace place = place_along_axis({0.08, 0.0, 0.08}, Vec3::UnitY(), 1, 0.16);
  const TextureSample sample = look_up(texture, place, 0.0);
  const double rise = 16.0 / 255.0 / 0.01;
  EXPECT_LT((sample.slope_W - Vec3(rise, 0, 0)).norm(), 1e-9);
  const Vec3 normal = bumped_normal(Vec3::UnitY(), sample, 0.02);
  EXPECT_LT((normal - Vec3(-0.02 * rise, 1.0, 0.0).normalized()).norm(), 1e-12);
}

TEST(TexturePlace, ANormalMapsColourIsADirection) {
  EXPECT_LT((mapped_normal({0.5, 0.5, 1.0}) - Vec3::UnitZ()).norm(), 1e-12);
  EXPECT_LT((mapped_normal({1.0, 0.5, 0.5}) - Vec3::UnitX()).norm(), 1e-12);
  EXPECT_EQ(mapped_normal({0.5, 0.5, 0.5}), Vec3::UnitZ());
}

}  // namespace
}  // namespace tactus::rendering
