#include "host_tools/benchmark/multiplications.h"

#include <gtest/gtest.h>

namespace tactus::host {
namespace {

// The numbers of rendering/geometry/plane_solutions.h, which its own tests count apart.
TEST(Multiplications, AreNoMoreThanTheLectures) {
  const Multiplications here = count_multiplications();
  EXPECT_EQ(here, (Multiplications{6, 33, 56}));
  for (std::size_t i = 0; i < here.size(); ++i) {
    EXPECT_LE(here.at(i), kMultiplicationsOfTheLecture.at(i));
  }
}

}  // namespace
}  // namespace tactus::host
