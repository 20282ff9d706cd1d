// The waves of a mesh, four vertices at a time. The oracle is the formula of one vertex, with the
// C library's sine.
#include "rendering/objects/vertex_wave.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <vector>

#include "rendering/objects/object.h"
#include "tests/support/materials.h"
#include "tests/support/solid.h"

namespace tactus::rendering {
namespace {

class VertexWaveTest : public ::testing::Test {
 protected:
  static constexpr std::uint64_t kSeed = 41;

  // Draws a mesh's vertices and normals at random.
  void draw(std::size_t count) {
    const auto vector = [this] {
      return Float3{static_cast<float>(unit_(random_)), static_cast<float>(unit_(random_)),
                    static_cast<float>(unit_(random_))};
    };
    vertices_.clear();
    normals_.clear();
    for (std::size_t i = 0; i < count; ++i) {
      vertices_.push_back(vector());
      normals_.push_back(to_float3(to_vec3(vector()).normalized()));
    }
  }

  std::mt19937_64 random_{kSeed};
  std::uniform_real_distribution<double> unit_{-1.0, 1.0};
  std::vector<Float3> vertices_;
  std::vector<Float3> normals_;
  std::unique_ptr<WavePool> pool_ = std::make_unique<WavePool>();
};

// A part of any length from anywhere has the bits that each vertex has alone.
TEST_F(VertexWaveTest, EveryVertexIsWhereItsOwnFormulaPutsIt) {
  for (std::size_t count = 1; count <= 23; ++count) {
    draw(count);
    const Motion motion{.wave_m = 0.01 * unit_(random_),
                        .wave_Hz = 3.0,
                        .wave_per_m = {unit_(random_), 7.0 * unit_(random_), unit_(random_)}};
    const std::size_t in_pool = count % 5;
    const WaveVertices all = pool_->start(motion, in_pool, vertices_, normals_);
    const double time_s = 1.0 + unit_(random_);
    const SineCosine of_time = wave_angle(motion, time_s);
    const std::size_t first = count / 3;
    std::vector<Float3> to(count - first);
    wave(motion, of_time, all.part(first, to.size()), to);
    for (std::size_t i = first; i < count; ++i) {
      const Vec3 rest = to_vec3(vertices_[i]);
      const Vec3 normal = to_vec3(normals_[i]);
      const double alone_m = wave_at(motion, wave_angle(motion, rest), of_time);
      EXPECT_EQ(to[i - first], to_float3(rest + alone_m * normal)) << count << ", " << i;
      const double sine = std::sin(2.0 * std::numbers::pi *
                                   (motion.wave_Hz * time_s - motion.wave_per_m.dot(rest)));
      const Vec3 true_place = rest + motion.wave_m * sine * normal;
      EXPECT_LE((to_vec3(to[i - first]) - true_place).norm(), 1e-6) << count << ", " << i;
    }
  }
}

TEST(VertexWave, AWaveThatWouldLeaveTheWorldIsNotUsable) {
  const testing::Solid sheet(testing::flat_sheet(0.01, 4), Sides::two, testing::kRough);
  std::vector<Float3> vertices(sheet.object().mesh.vertices.begin(),
                               sheet.object().mesh.vertices.end());
  const std::vector<Float3> up(vertices.size(), Float3{0.0F, 1.0F, 0.0F});
  const Motion motion{.wave_m = -0.5, .wave_Hz = 1.0};
  Object object = sheet.object();
  object.deforms = true;
  object.motion = &motion;
  object.vertex_normals = up;
  object.mesh.vertices = vertices;
  EXPECT_TRUE(usable(object));
  vertices[7].y = 99.75F;
  EXPECT_FALSE(usable(object));
  vertices[7].y = std::nanf("");
  EXPECT_FALSE(usable(object));
}

}  // namespace
}  // namespace tactus::rendering
