#include "drivers/gpio_axis/edge_encoder.h"

#include <numbers>

#include "tests/unit/hal/random.h"

#include <gtest/gtest.h>

namespace tactus::drivers {
namespace {

constexpr EncoderConfig kEdgeEncoder{.counts_per_rev = 400, .max_speed_rad_per_s = 100.0};
constexpr hal::TimeNs kApart_ns = 1'000'000;

// The Gray code of a position, from its definition: A is high in the second and third quarter of a
// line, B in the third and fourth.
bool channel_a(std::int64_t position) {
  const auto quarter = static_cast<std::uint64_t>(position) % 4U;
  return quarter == 1 || quarter == 2;
}
bool channel_b(std::int64_t position) {
  const auto quarter = static_cast<std::uint64_t>(position) % 4U;
  return quarter == 2 || quarter == 3;
}

TEST(QuadratureStep, AgreesWithEveryPairOfPositions) {
  for (std::int64_t from = -8; from < 8; ++from) {
    for (std::int64_t to = from - 2; to <= from + 2; ++to) {
      const int step = quadrature_step(quadrature_state(channel_a(from), channel_b(from)),
                                       quadrature_state(channel_a(to), channel_b(to)));
      const bool is_double = to - from == 2 || from - to == 2;
      EXPECT_EQ(step, is_double ? kIllegalStep : static_cast<int>(to - from))
          << from << " to " << to;
    }
  }
}

class EdgeEncoderTest : public ::testing::Test {
 protected:
  EdgeEncoderTest() { encoder_.restart(false, false, false, now_ns_); }

  void edge(EncoderChannel channel, bool rising, hal::TimeNs after_ns = kApart_ns) {
    now_ns_ += after_ns;
    encoder_.take(channel, rising, now_ns_);
  }
  // A true encoder's step, as the edge that it makes.
  void step(int direction) {
    const std::int64_t next = position_ + direction;
    if (channel_a(next) != channel_a(position_)) {
      edge(EncoderChannel::a, channel_a(next));
    } else {
      edge(EncoderChannel::b, channel_b(next));
    }
    position_ = next;
  }
  void steps(int count) {
    for (int i = 0; i < (count < 0 ? -count : count); ++i) {
      step(count < 0 ? -1 : 1);
    }
  }
  EncoderReading reading() { return encoder_.reading(now_ns_); }

  EdgeEncoder encoder_{kEdgeEncoder, true};
  hal::TimeNs now_ns_ = 1'000'000'000;
  std::int64_t position_ = 0;
};

TEST_F(EdgeEncoderTest, FollowsARandomWalkCountForCount) {
  hal::Random random(5);
  EdgeEncoder without_index(kEdgeEncoder, false);
  encoder_ = without_index;
  encoder_.restart(false, false, false, now_ns_);
  for (int i = 0; i < 100'000; ++i) {
    step(random.one_in(3) ? -1 : 1);
    ASSERT_EQ(reading().count, position_);
  }
  EXPECT_EQ(reading().fault, EncoderFault::none);
  EXPECT_EQ(encoder_.illegal_transitions(), 0U);
}

TEST_F(EdgeEncoderTest, ALevelThatRepeatsEndsThePosition) {
  steps(3);
  edge(EncoderChannel::a, true);
  edge(EncoderChannel::a, true);
  EXPECT_EQ(reading().fault, EncoderFault::illegal_transition);
  EXPECT_GE(encoder_.illegal_transitions(), 1U);
}

TEST_F(EdgeEncoderTest, BothChannelsAtOnceEndThePosition) {
  edge(EncoderChannel::a, true);
  edge(EncoderChannel::b, true, 0);
  EXPECT_EQ(reading().fault, EncoderFault::illegal_transition);
}

TEST_F(EdgeEncoderTest, EdgesAsFastAsTheFastestShaftAreBelieved) {
  const double interval_s = 2.0 * std::numbers::pi / 400 / 100.0;
  const auto interval_ns = static_cast<hal::TimeNs>(1e9 * interval_s);
  edge(EncoderChannel::a, true);
  edge(EncoderChannel::b, true, interval_ns);
  edge(EncoderChannel::a, false, interval_ns);
  EXPECT_EQ(reading().fault, EncoderFault::none);
  EXPECT_EQ(reading().count, 3);
}

TEST(EdgeEncoderLimit, InterruptsThatWaitedTogetherAreRejectedAtAnySpeed) {
  EdgeEncoder encoder({.counts_per_rev = 4000, .max_speed_rad_per_s = 1e5}, false);
  encoder.restart(false, false, false, 1000);
  encoder.take(EncoderChannel::a, true, 1'000'000);
  encoder.take(EncoderChannel::b, true, 1'000'000 + EdgeEncoder::kInterrupts_ns - 1);
  EXPECT_EQ(encoder.reading(2'000'000).fault, EncoderFault::illegal_transition);
}

TEST_F(EdgeEncoderTest, TremblingOnOneEdgeIsNoMatterOfSpeed) {
  for (int i = 0; i < 10; ++i) {
    edge(EncoderChannel::a, i % 2 == 0, 50);
  }
  EXPECT_EQ(reading().fault, EncoderFault::none);
  EXPECT_EQ(reading().count, 0);
}

TEST_F(EdgeEncoderTest, EdgesFromBeforeTheRestartAreInItsLevels) {
  encoder_.restart(true, false, false, now_ns_);
  encoder_.take(EncoderChannel::a, true, now_ns_ - 1);
  EXPECT_EQ(reading().fault, EncoderFault::none);
  EXPECT_EQ(reading().count, 0);
}

TEST_F(EdgeEncoderTest, LevelsMayDisagreeForAnInterruptsDelayOnly) {
  encoder_.compare(true, false, now_ns_);
  encoder_.compare(true, false, now_ns_ + EdgeEncoder::kDisagreement_ns - 1);
  EXPECT_EQ(reading().fault, EncoderFault::none);
  encoder_.compare(true, false, now_ns_ + EdgeEncoder::kDisagreement_ns);
  EXPECT_EQ(reading().fault, EncoderFault::levels_disagree);
}

TEST_F(EdgeEncoderTest, AnEdgeOrAgreementEndsTheDisagreement) {
  encoder_.compare(true, false, now_ns_);
  edge(EncoderChannel::a, true);
  encoder_.compare(true, true, now_ns_);
  encoder_.compare(true, false, now_ns_ + EdgeEncoder::kDisagreement_ns);
  encoder_.compare(true, true, now_ns_ + 2 * EdgeEncoder::kDisagreement_ns);
  EXPECT_EQ(reading().fault, EncoderFault::none);
}

// A pulse that begins and ends within the state in which both channels are high, as the index of a
// gated encoder does, or reaches into its neighbours.
TEST_F(EdgeEncoderTest, IndexIsTheSameCountFromEitherSide) {
  steps(1);
  edge(EncoderChannel::index, true);
  steps(1);
  EXPECT_TRUE(reading().index_seen);
  EXPECT_EQ(reading().index_count, 2);
  steps(1);
  edge(EncoderChannel::index, false);
  steps(5);
  steps(-5);
  edge(EncoderChannel::index, true);
  steps(-1);
  EXPECT_EQ(reading().index_count, 2);
  EXPECT_EQ(reading().fault, EncoderFault::none);
}

TEST_F(EdgeEncoderTest, IndexATurnLaterIsInItsPlace) {
  steps(2);
  edge(EncoderChannel::index, true);
  edge(EncoderChannel::index, false);
  steps(400);
  edge(EncoderChannel::index, true);
  EXPECT_EQ(reading().index_count, 402);
  EXPECT_EQ(encoder_.index_error(), 0);
  EXPECT_EQ(reading().fault, EncoderFault::none);
}

TEST_F(EdgeEncoderTest, IndexOutOfItsPlaceEndsThePosition) {
  steps(2);
  edge(EncoderChannel::index, true);
  edge(EncoderChannel::index, false);
  steps(396);
  edge(EncoderChannel::index, true);
  EXPECT_EQ(encoder_.index_error(), -4);
  EXPECT_EQ(reading().fault, EncoderFault::index_moved);
}

TEST_F(EdgeEncoderTest, ATurnAndAQuarterWithoutAnIndexEndsThePosition) {
  steps(500);
  EXPECT_EQ(reading().fault, EncoderFault::none);
  steps(1);
  EXPECT_EQ(reading().fault, EncoderFault::index_missing);
}

TEST_F(EdgeEncoderTest, TheFirstFaultStaysUntilTheRestart) {
  encoder_.fail(EncoderFault::edges_lost);
  edge(EncoderChannel::a, false);
  EXPECT_EQ(reading().fault, EncoderFault::edges_lost);
  encoder_.restart(false, false, false, now_ns_);
  EXPECT_EQ(reading().fault, EncoderFault::none);
  EXPECT_EQ(reading().count, 0);
  EXPECT_FALSE(reading().index_seen);
}

}  // namespace
}  // namespace tactus::drivers
