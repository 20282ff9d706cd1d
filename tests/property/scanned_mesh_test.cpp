// The same as proxy_property_test.cpp, and as long, on a mesh that a scanner made: Debian's copy of
// the Stanford bunny, with holes in its bottom and slivers where scans were zipped together.
#include <gtest/gtest.h>

#include "host_tools/benchmark/benchmark_mesh.h"
#include "tests/property/proxy_walk.h"
#include "tests/property/starts_in_touch.h"
#include "tests/support/share.h"

namespace tactus::testing {
namespace {

TEST(ScannedMesh, IsNeverCrossedAndTheProxyRestsAtALocalMinimum) {
  constexpr double kLongestSide_m = 0.1;
  const auto bunny = host::bunny_mesh(kLongestSide_m);
  if (!bunny) {
    GTEST_SKIP() << "no bunny: Debian's libcgal-demo is not installed";
  }
  const rendering::MeshView mesh = bunny->mesh.view();
  const Shape shape{.name = "bunny",
                    .closed = false,
                    .vertices = {mesh.vertices.begin(), mesh.vertices.end()},
                    .triangles = {mesh.triangles.begin(), mesh.triangles.end()}};
  const std::size_t ticks = share_of(std::size_t{1'000'000}) / 4;
  ProxyTally all;
  std::uint64_t seed = 501;
  for (const double radius_m : {0.0, 0.002}) {
    for (const bool friction : {false, true}) {
      ProxyTally tally;
      walk_about({shape, rendering::Sides::two, radius_m, friction}, seed++, ticks, tally);
      if (HasFatalFailure()) {
        return;
      }
      all.add(tally);
    }
  }
  std::printf(
      "%zu ticks, %zu in contact, %zu cut short by a limit; least clearance beyond the "
      "radius %.3f um, largest descent left %.3g um\n",
      4 * ticks, all.contacts, all.unfinished, 1e6 * all.worst_clearance_m,
      1e6 * all.worst_descent_m);
  EXPECT_GT(all.contacts, 0U);
}

TEST(ScannedMesh, AToolThatBeginsInTouchFeelsNothingUntilItHasLeft) {
  const auto bunny = host::bunny_mesh(0.1);
  if (!bunny) {
    GTEST_SKIP() << "no bunny: Debian's libcgal-demo is not installed";
  }
  const rendering::MeshView mesh = bunny->mesh.view();
  const Shape shape{.name = "bunny",
                    .closed = false,
                    .vertices = {mesh.vertices.begin(), mesh.vertices.end()},
                    .triangles = {mesh.triangles.begin(), mesh.triangles.end()}};
  StartTally tally;
  std::uint64_t seed = 701;
  for (const double radius_m : {0.002, 0.005}) {
    for (const double friction : {0.0, 0.8}) {
      for (const rendering::Sides sides : {rendering::Sides::one, rendering::Sides::two}) {
        leave_from({shape, sides, radius_m, friction}, seed++, share_of(std::size_t{100}), tally);
        if (HasFatalFailure()) {
          return;
        }
      }
    }
  }
  std::printf("%zu starts in touch, %zu came away\n", tally.starts, tally.ended);
  EXPECT_GT(tally.ended, 0U);
}

}  // namespace
}  // namespace tactus::testing
