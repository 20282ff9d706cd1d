#include "host_tools/plot/silhouette.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "tests/support/solid.h"

namespace tactus::host {
namespace {

using testing::Solid;

constexpr int kPixels = 200;

Window square(double half_m) {
  Window window;
  window.include({.right = -half_m, .up = -half_m});
  window.include({.right = half_m, .up = half_m});
  return window;
}

double covered_share(const GreyImage& image) {
  const auto covered = std::count_if(image.pixels.begin(), image.pixels.end(),
                                     [](std::uint8_t g) { return g < 250; });
  return static_cast<double>(covered) / static_cast<double>(image.pixels.size());
}

std::uint8_t at(const GreyImage& image, int column, int row) {
  return image.pixels[static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width) +
                      static_cast<std::size_t>(column)];
}

TEST(Silhouette, ASphereCoversTheDiscOfItsRadius) {
  const Solid ball(testing::icosphere(0.5, 4), rendering::Sides::one, {});
  for (const View view : {View::front, View::side}) {
    const GreyImage image =
        draw_silhouette(view, square(1.0), kPixels, kPixels, {&ball.object(), 1});
    EXPECT_NEAR(covered_share(image), std::numbers::pi * 0.25 / 4.0, 0.005);
  }
}

TEST(Silhouette, BoxesStandWhereTheirSideOfTheWorldIs) {
  // A slab at +x, up, toward the user: right half and upper half in front, right and upper half
  // from the left.
  const Solid slab(testing::moved(testing::box({0.4, 0.4, 0.4}), {0.5, 0.5, 0.5}),
                   rendering::Sides::one, {});
  for (const View view : {View::front, View::side}) {
    const GreyImage image =
        draw_silhouette(view, square(1.0), kPixels, kPixels, {&slab.object(), 1});
    EXPECT_LT(at(image, 3 * kPixels / 4, 3 * kPixels / 4), 250);
    EXPECT_EQ(at(image, kPixels / 4, 3 * kPixels / 4), 255);
    EXPECT_EQ(at(image, 3 * kPixels / 4, kPixels / 4), 255);
    EXPECT_NEAR(covered_share(image), 0.16 / 4.0, 0.002);
  }
}

TEST(Silhouette, LightComesFromTheUpperLeftOfTheViewer) {
  const Solid ball(testing::icosphere(0.5, 4), rendering::Sides::one, {});
  for (const View view : {View::front, View::side}) {
    const GreyImage image =
        draw_silhouette(view, square(1.0), kPixels, kPixels, {&ball.object(), 1});
    EXPECT_GT(at(image, kPixels / 2 - 20, kPixels / 2 + 30),
              at(image, kPixels / 2 + 20, kPixels / 2 - 30) + 10);
  }
}

TEST(Silhouette, BoundsHoldEveryVertex) {
  const Solid box(testing::moved(testing::box({0.2, 0.4, 0.6}), {1.0, 2.0, 3.0}),
                  rendering::Sides::one, {});
  const Window side = bounds(View::side, {&box.object(), 1});
  EXPECT_NEAR(side.lower.right, 2.7, 1e-6);
  EXPECT_NEAR(side.upper.right, 3.3, 1e-6);
  EXPECT_NEAR(side.height(), 0.4, 1e-6);
}

}  // namespace
}  // namespace tactus::host
