// The grid that finds triangles for the random walks, against brute force over all of them.
#include "tests/support/triangle_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "tests/property/wanderer.h"
#include "tests/support/share.h"

namespace tactus::testing {
namespace {

TEST(TriangleGrid, FindsEveryTriangleThatIsNear) {
  std::mt19937_64 random(1);
  const auto somewhere = [&] {
    std::uniform_real_distribution<double> place(-0.06, 0.06);
    return Vec3{place(random), place(random), place(random)};
  };
  std::vector<Shape> shapes = wandered_shapes();
  shapes.push_back(icosphere(0.03, 5));
  for (const Shape& shape : shapes) {
    const std::vector<Corners> all = corners_of(shape);
    TriangleGrid grid(all);
    for (int k = 0; k < std::max(48, part_of(200)); ++k) {
      const Vec3 p = somewhere();
      const Vec3 q = p + std::pow(0.1, k % 4) * (somewhere() - p);
      const double reach = 0.002 * (1 + k % 3);
      ASSERT_EQ(std::min(reach, clearance(grid.near(p, q, reach), p, q, reach)),
                std::min(reach, clearance(all, p, q, reach)))
          << shape.name << " from " << p.transpose() << " to " << q.transpose();
    }
  }
}

TEST(TriangleGrid, AsksFewOfALargeMesh) {
  const std::vector<Corners> all = corners_of(icosphere(0.03, 6));
  TriangleGrid grid(all);
  const Vec3 touching{0.0, 0.0, 0.032};
  EXPECT_LT(grid.near(touching, touching, 0.002).size(), all.size() / 20);
}

}  // namespace
}  // namespace tactus::testing
