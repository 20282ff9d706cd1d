#include "drivers/common/read_score.h"

#include <gtest/gtest.h>

namespace tactus::drivers {
namespace {

TEST(ReadScore, ThreeBadReadsInARowAreAFault) {
  ReadScore score;
  EXPECT_FALSE(score.bad());
  EXPECT_FALSE(score.bad());
  EXPECT_TRUE(score.bad());
}

// Returns true if a run of 1000 reads, of which each `kth` is bad, has a fault.
bool is_fault_in_a_run(int kth) {
  ReadScore score;
  bool has_fault = false;
  for (int read = 1; read <= 1000; ++read) {
    if (read % kth == 0) {
      has_fault = score.bad() || has_fault;
    } else {
      score.good();
    }
  }
  return has_fault;
}

TEST(ReadScore, MoreThanAQuarterOfBadReadsIsAFaultInTheLongRunAndLessIsNone) {
  EXPECT_TRUE(is_fault_in_a_run(3));
  EXPECT_FALSE(is_fault_in_a_run(5));
}

}  // namespace
}  // namespace tactus::drivers
