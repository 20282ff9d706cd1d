#include "rendering/geometry/near_segment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "rendering/geometry/triangle.h"

namespace tactus::rendering {
namespace {

// Loose triangles about a middle.
class NearSegmentTest : public ::testing::Test {
 protected:
  static constexpr std::uint64_t kSeed = 12;

  double unit() { return std::uniform_real_distribution<double>(0.0, 1.0)(random_); }
  Vec3 vector() { return {2.0 * unit() - 1.0, 2.0 * unit() - 1.0, 2.0 * unit() - 1.0}; }

  void make_triangles(std::uint32_t count, const Vec3& middle, double scale) {
    vertices_.clear();
    triangles_.clear();
    for (std::uint32_t t = 0; t < count; ++t) {
      const Vec3 at = middle + scale * vector();
      const double size = scale * std::pow(10.0, -3.0 * unit());
      for (int corner = 0; corner < 3; ++corner) {
        vertices_.push_back(to_float3(at + size * vector()));
      }
      const std::uint32_t first = 3 * t;
      if (t % 7 == 3) {
        vertices_[first + 1] = vertices_[first];  // a line
      }
      triangles_.push_back({first, first + 1, first + 2});
    }
  }
  [[nodiscard]] MeshView mesh() const { return {.vertices = vertices_, .triangles = triangles_}; }
  [[nodiscard]] std::array<Vec3, 3> corners(std::uint32_t t) const {
    const auto& [a, b, c] = triangles_[t];
    return {to_vec3(vertices_[a]), to_vec3(vertices_[b]), to_vec3(vertices_[c])};
  }
  [[nodiscard]] Triangle triangle(std::uint32_t t) const {
    const auto [a, b, c] = corners(t);
    return {a, b, c};
  }

  std::mt19937_64 random_{kSeed};
  std::vector<Float3> vertices_;
  std::vector<TriangleIndices> triangles_;
};

std::map<std::uint32_t, NearSegment::Bound> found_by(const NearSegment& segment,
                                                     const MeshView& mesh) {
  std::map<std::uint32_t, NearSegment::Bound> found;
  segment.find(mesh, 0, static_cast<std::uint32_t>(mesh.triangles.size()),
               [&](std::uint32_t t, const NearSegment::Bound& bound) {
                 EXPECT_TRUE(found.emplace(t, bound).second);
               });
  return found;
}

TEST_F(NearSegmentTest, FindsAllThatComeNearAndBoundsTheirDistanceFromBelow) {
  int far = 0;
  for (int k = 0; k < 4'000; ++k) {
    SCOPED_TRACE("seed " + std::to_string(kSeed) + ", case " + std::to_string(k));
    const Vec3 middle = std::pow(10.0, 5.0 * unit() - 3.0) * vector();
    const double scale = std::pow(10.0, 3.0 * unit() - 3.0);
    const auto count = static_cast<std::uint32_t>(1 + k % 9);
    make_triangles(count, middle, scale);
    const Vec3 start = middle + scale * vector();
    const Vec3 along = k % 5 == 0 ? Vec3{Vec3::Zero()} : Vec3{scale * vector()};
    const double reach = 0.5 * scale * unit();
    const auto found = found_by(NearSegment(start, along, reach), mesh());
    for (std::uint32_t t = 0; t < count; ++t) {
      double nearest = 1e9;
      for (int i = 0; i <= 50; ++i) {
        nearest = std::min(nearest, triangle(t).nearest(start + i / 50.0 * along).distance);
      }
      const auto place = found.find(t);
      if (place == found.end()) {
        ++far;
        EXPECT_GE(nearest, reach) << t;
        continue;
      }
      const Vec3 normal = to_vec3(place->second.normal);
      EXPECT_LE(normal.norm(), 1.0);
      for (int i = 0; i < 20; ++i) {
        const Vec3 offset = scale * vector();
        const double bound = normal.dot(offset) - static_cast<double>(place->second.offset);
        EXPECT_LE(bound, triangle(t).nearest(start + offset).distance) << t;
      }
    }
  }
  EXPECT_GT(far, 5'000) << "of some 20,000";
}

// The plane is normal to the gap D from the middle of a triangle, whose corners are at most r from
// it. The foremost corner is h in front of the middle and at most r aside: it is nearer than
// (D - h) + r^2 / (2 (D - h)), of which the plane tells the first.
TEST_F(NearSegmentTest, BoundsASmallTriangleNearlyByItsDistance) {
  constexpr double kAll = 1e3;
  int asked = 0;
  for (int k = 0; k < 2'000; ++k) {
    SCOPED_TRACE("seed " + std::to_string(kSeed) + ", case " + std::to_string(k));
    make_triangles(8, Vec3::Zero(), 1.0);
    const Vec3 start = 2.0 * vector();
    for (const auto& [t, bound] : found_by(NearSegment(start, Vec3::Zero(), kAll), mesh())) {
      const auto [a, b, c] = corners(t);
      const Vec3 middle = (a + b + c) / 3.0;
      const double gap = (start - middle).norm();
      const double r = std::max({(a - middle).norm(), (b - middle).norm(), (c - middle).norm()});
      if (gap < 2.0 * r) {
        continue;
      }
      ++asked;
      constexpr double kRounding = 1e-5;
      const double short_by =
          triangle(t).nearest(start).distance + static_cast<double>(bound.offset);
      EXPECT_LE(short_by, r * r / (2.0 * (gap - r)) + kRounding) << t;
    }
  }
  EXPECT_GT(asked, 10'000) << "of 16,000";
}

TEST_F(NearSegmentTest, LooksAtTheTrianglesAskedForAlone) {
  make_triangles(12, Vec3::Zero(), 1.0);
  std::vector<std::uint32_t> found;
  NearSegment(Vec3::Zero(), Vec3::Zero(), 100.0)
      .find(mesh(), 5, 6, [&](std::uint32_t t, const NearSegment::Bound&) { found.push_back(t); });
  EXPECT_EQ(found, (std::vector<std::uint32_t>{5, 6, 7, 8, 9, 10}));
}

}  // namespace
}  // namespace tactus::rendering
