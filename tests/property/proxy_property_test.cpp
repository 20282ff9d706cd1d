// The sphere proxy against brute force over all triangles: random tools on many meshes.
#include <gtest/gtest.h>

#include "tests/property/proxy_walk.h"
#include "tests/property/wanderer.h"
#include "tests/support/share.h"

namespace tactus::testing {
namespace {

using rendering::Sides;

// Fewer ticks on a shape may pass beside it.
constexpr std::size_t kTicksToMeetEveryShape = 2'000;

TEST(SphereProxy, CrossesNoTriangleKeepsItsRadiusAndRestsAtALocalMinimum) {
  std::vector<ProxyCase> cases;
  for (const Shape& shape : wandered_shapes()) {
    for (const double radius_m : {0.0, 0.001, 0.004}) {
      cases.push_back({shape, shape.closed ? Sides::one : Sides::two, radius_m, false});
      cases.push_back({shape, Sides::two, radius_m, true});
    }
  }
  const std::size_t ticks = share_of(std::size_t{1'000'000}) / cases.size() + 1;
  ProxyTally all;
  std::uint64_t seed = 1;
  for (const ProxyCase& c : cases) {
    ProxyTally tally;
    walk_about(c, seed++, ticks, tally);
    if (ticks >= kTicksToMeetEveryShape) {
      EXPECT_GT(tally.contacts, ticks / 100) << c.shape.name << ": the wanderer hardly touched it";
    }
    if (HasFatalFailure()) {
      return;
    }
    all.add(tally);
    if (tally.unfinished > 0) {
      std::printf("%-40s radius %.3f friction %d: %zu of %zu ticks unfinished\n",
                  c.shape.name.c_str(), c.radius_m, c.friction, tally.unfinished, ticks);
    }
  }
  std::printf(
      "%zu ticks on %zu cases, %zu in contact, %zu cut short by a limit; least clearance beyond "
      "the radius %.3f um, "
      "largest descent left %.3g um\n",
      ticks * cases.size(), cases.size(), all.contacts, all.unfinished, 1e6 * all.worst_clearance_m,
      1e6 * all.worst_descent_m);
  EXPECT_LE(all.unfinished, all.contacts / 125) << "sub-goals run out too often";
}

}  // namespace
}  // namespace tactus::testing
