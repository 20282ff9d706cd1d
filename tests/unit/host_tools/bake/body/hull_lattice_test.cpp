// The side of a plane on a lattice, against a determinant in 128-bit numbers.
#include "host_tools/bake/body/hull_lattice.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <map>
#include <random>
#include <vector>

namespace tactus::host {
namespace {

__extension__ using Wide = __int128;

int side_by_wide_numbers(const HullLattice& lattice, const std::array<std::uint32_t, 4>& corner) {
  std::array<std::array<Wide, 3>, 3> edge;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      edge[i][k] = Wide{lattice.point(corner[i + 1])[k]} - lattice.point(corner[0])[k];
    }
  }
  const auto& [u, v, w] = edge;
  const Wide volume = (u[1] * v[2] - u[2] * v[1]) * w[0] + (u[2] * v[0] - u[0] * v[2]) * w[1] +
                      (u[0] * v[1] - u[1] * v[0]) * w[2];
  return static_cast<int>(volume > 0) - static_cast<int>(volume < 0);
}

// Corners of the box, where the numbers are largest, points at random, and points at random whose
// planes hold many others.
TEST(HullLattice, SidesAreThoseOfExactDeterminants) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> anywhere(-1.0, 1.0);
  std::uniform_int_distribution<int> coarse(-2, 2);
  std::vector<Vec3> points;
  points.reserve(8 + 2 * 40);
  for (int corner = 0; corner < 8; ++corner) {
    points.emplace_back((corner & 1) != 0 ? 1.0 : -1.0, (corner & 2) != 0 ? 1.0 : -1.0,
                        (corner & 4) != 0 ? 1.0 : -1.0);
  }
  for (int i = 0; i < 40; ++i) {
    points.emplace_back(anywhere(random), anywhere(random), anywhere(random));
    points.emplace_back(0.5 * coarse(random), 0.5 * coarse(random), 0.5 * coarse(random));
  }
  const HullLattice lattice(points);
  std::uniform_int_distribution<std::uint32_t> any(0,
                                                   static_cast<std::uint32_t>(points.size() - 1));
  std::map<int, int> found;
  for (int i = 0; i < 200'000; ++i) {
    const std::array<std::uint32_t, 4> corner{any(random), any(random), any(random), any(random)};
    const int side = lattice.side(corner[0], corner[1], corner[2], corner[3]);
    ASSERT_EQ(side, side_by_wide_numbers(lattice, corner));
    ++found[side];
  }
  for (const int side : {-1, 0, 1}) {
    EXPECT_GT(found[side], 1000) << side;
  }
}

}  // namespace
}  // namespace tactus::host
