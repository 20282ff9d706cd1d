#include "host_tools/bake/scene/closed_volume.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "host_tools/bake/scene/mesh_bake.h"
#include "host_tools/mesh/icosphere.h"
#include "tests/unit/host_tools/bake/scene/box_files.h"
#include "tests/unit/host_tools/bake/temporary_folder.h"

namespace tactus::host {
namespace {

using rendering::Float3;

// Builds meshes of boxes.
class Boxes {
 public:
  // Adds a box from one corner to the other, inside out if it is asked for.
  Boxes& add(const Float3& lower, const Float3& upper, bool inside_out = false) {
    const auto first = static_cast<std::uint32_t>(mesh_.vertices.size());
    for (const auto& c : testing::kBoxCorners) {
      mesh_.vertices.push_back({c[0] > 0 ? upper.x : lower.x, c[1] > 0 ? upper.y : lower.y,
                                c[2] > 0 ? upper.z : lower.z});
    }
    for (rendering::TriangleIndices t : testing::kBoxTriangles) {
      if (inside_out) {
        std::swap(t[0], t[1]);
      }
      mesh_.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    }
    return *this;
  }

  [[nodiscard]] std::optional<ClosedVolume> measured() const {
    const BakedMesh baked = bake_mesh(mesh_);
    return closed_volume(baked.baked_view());
  }

  TriangleMesh& mesh() { return mesh_; }

 private:
  TriangleMesh mesh_;
};

TEST(ClosedVolume, IsThatOfTheClosedForm) {
  const auto box = Boxes().add({1, 1, 1}, {1.5F, 2, 5}).measured();
  ASSERT_TRUE(box);
  EXPECT_NEAR(box->volume_m3, 0.5 * 1.0 * 4.0, 1e-6);
  EXPECT_EQ(box->parts, 1U);
  EXPECT_EQ(box->inside_out, 0U);
  const BakedMesh ball = bake_mesh(icosphere(0.1, 5));
  EXPECT_NEAR(closed_volume(ball.baked_view())->volume_m3, 4.0 / 3.0 * M_PI * 1e-3, 1e-5);
}

TEST(ClosedVolume, IsNegativeForAMeshThatIsInsideOut) {
  const auto box = Boxes().add({1, 1, 1}, {1.5F, 2, 5}, true).measured();
  ASSERT_TRUE(box);
  EXPECT_NEAR(box->volume_m3, -2.0, 1e-6);
  EXPECT_EQ(box->inside_out, 1U);
  const auto warning = inside_out_warning(box, "write flip = true at the object");
  ASSERT_TRUE(warning);
  EXPECT_EQ(*warning,
            "the mesh is inside out: it is closed and its volume is -2 m^3, so the tool goes in "
            "unfelt and is held inside; write flip = true at the object");
}

TEST(ClosedVolume, TakesAHollowForWhatItIs) {
  const auto hollow = Boxes().add({0, 0, 0}, {3, 3, 3}).add({1, 1, 1}, {2, 2, 2}, true).measured();
  ASSERT_TRUE(hollow);
  EXPECT_NEAR(hollow->volume_m3, 26.0, 1e-5);
  EXPECT_EQ(hollow->parts, 2U);
  EXPECT_EQ(hollow->inside_out, 0U);
  EXPECT_FALSE(inside_out_warning(hollow, ""));
}

TEST(ClosedVolume, FindsOnePartThatIsInsideOutBesideAnother) {
  const auto two = Boxes().add({0, 0, 0}, {3, 3, 3}).add({4, 0, 0}, {5, 1, 1}, true).measured();
  ASSERT_TRUE(two);
  EXPECT_EQ(two->inside_out, 1U);
  const auto warning = inside_out_warning(two, "");
  ASSERT_TRUE(warning);
  EXPECT_TRUE(testing::contains(*warning, "1 of the 2 closed parts of the mesh are inside out"));
}

TEST(ClosedVolume, IsNothingForAMeshThatIsOpenOrWoundInconsistently) {
  Boxes open;
  open.add({0, 0, 0}, {1, 1, 1}).mesh().triangles.pop_back();
  EXPECT_FALSE(open.measured());
  Boxes mixed;
  mixed.add({0, 0, 0}, {1, 1, 1});
  std::swap(mixed.mesh().triangles[4][0], mixed.mesh().triangles[4][1]);
  EXPECT_FALSE(mixed.measured());
}

TEST(ClosedVolume, HasNoSignForASheetWithFacesBackToBack) {
  TriangleMesh sheet{.vertices = {{0, 0, 0}, {1, 0, 0.3F}, {0.2F, 1, 0.1F}},
                     .triangles = {{0, 1, 2}, {0, 2, 1}}};
  const BakedMesh baked = bake_mesh(sheet);
  const auto volume = closed_volume(baked.baked_view());
  EXPECT_TRUE(!volume || volume->inside_out == 0);
}

}  // namespace
}  // namespace tactus::host
