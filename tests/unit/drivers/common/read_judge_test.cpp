#include "drivers/common/read_judge.h"

#include <gtest/gtest.h>

namespace tactus::drivers {
namespace {

constexpr Trouble kOddAnswer{.what = "an odd answer", .remedy = ""};

// Returns the number of reads, each as `play` makes it, after which the device is at fault; 0: it
// is not after 100.
template <class Play>
int reads_until_fault(Play play) {
  ReadJudge judge;
  for (int read = 1; read <= 100; ++read) {
    judge.begin();
    play(judge);
    if (judge.end_in_fault()) {
      return read;
    }
  }
  return 0;
}

TEST(ReadJudge, ADeviceThatDoesNotAnswerIsAtFaultAfterThreeReads) {
  EXPECT_EQ(reads_until_fault([](ReadJudge& /*judge*/) {}), 3);
}

TEST(ReadJudge, ABelievableAnswerOutweighsARejectedOne) {
  EXPECT_EQ(reads_until_fault([](ReadJudge& judge) {
              judge.doubt(kOddAnswer);
              judge.believe();
              EXPECT_TRUE(judge.is_fresh());
            }),
            0);
}

TEST(ReadJudge, AnAnswerThatNobodyAskedForOutweighsABelievableOne) {
  EXPECT_EQ(reads_until_fault([](ReadJudge& judge) {
              judge.believe();
              judge.doubt_unasked(kOddAnswer);
            }),
            3);
}

TEST(ReadJudge, ANewReadHasNoDoubt) {
  ReadJudge judge;
  judge.begin();
  judge.doubt(kOddAnswer);
  EXPECT_EQ(judge.doubt().what, kOddAnswer.what);
  judge.begin();
  EXPECT_FALSE(judge.doubt());
}

}  // namespace
}  // namespace tactus::drivers
