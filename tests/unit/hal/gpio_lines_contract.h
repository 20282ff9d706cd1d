// The contract of every GpioLines. A rig has a chip of at least eight lines that nobody holds:
//   GpioLines& lines(), GpioLines& other_lines()   two requests on that chip
//   Clock& clock()
//   void drive(offset, high)   sets the physical level of an input, and waits until the interrupt
//                              has been served
//   bool level(offset)         the physical level of an output
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "hal/gpio_lines.h"

namespace tactus::hal {

template <class Rig>
class GpioLinesContract : public ::testing::Test {
 protected:
  static constexpr TimeNs kPatience = 100'000'000;

  GpioLines& lines() { return rig_.lines(); }
  TimeNs soon() { return rig_.clock().now_ns() + kPatience; }

  static GpioLineConfig input(std::uint32_t offset, GpioEdges edges = GpioEdges::none) {
    return {.offset = offset, .direction = GpioDirection::input, .edges = edges};
  }
  static GpioLineConfig output(std::uint32_t offset, bool active = false) {
    return {.offset = offset, .direction = GpioDirection::output, .initial_active = active};
  }

  Result<void> request(std::initializer_list<GpioLineConfig> configs, std::size_t buffer = 0) {
    return lines().request(
        {.lines = std::span(configs.begin(), configs.size()), .edge_buffer = buffer});
  }

  template <class T>
  void expect_refused(const Result<T>& result, ErrorCode code) {
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, code);
  }

  std::vector<GpioEdgeEvent> drain() {
    std::vector<GpioEdgeEvent> all;
    std::array<GpioEdgeEvent, 8> some;
    while (true) {
      const auto count = lines().read_edges(some, soon());
      if (!count) {
        EXPECT_EQ(count.error().code, ErrorCode::timeout);
        return all;
      }
      all.insert(all.end(), some.begin(), some.begin() + static_cast<std::ptrdiff_t>(*count));
    }
  }

  Rig rig_;
};

TYPED_TEST_SUITE_P(GpioLinesContract);

TYPED_TEST_P(GpioLinesContract, ReadsSeveralLinesAtOnce) {
  for (const std::size_t offset : {1U, 3U, 5U}) {
    this->rig_.drive(offset, offset != 3);
  }
  ASSERT_TRUE(this->request({this->input(5), this->input(3), this->input(1)}));
  EXPECT_EQ(this->lines().line_count(), 3U);
  EXPECT_EQ(this->lines().get(0b111), 0b101U);
  EXPECT_EQ(this->lines().get(0b110), 0b100U);
  this->rig_.drive(3, true);
  EXPECT_EQ(this->lines().get(0b111), 0b111U);
}

TYPED_TEST_P(GpioLinesContract, SetsOnlyTheLinesInTheMask) {
  ASSERT_TRUE(
      this->request({this->output(0, true), this->output(1, false), this->output(2, true)}));
  EXPECT_TRUE(this->rig_.level(0));
  EXPECT_FALSE(this->rig_.level(1));
  EXPECT_TRUE(this->rig_.level(2));
  ASSERT_TRUE(this->lines().set(0b011, 0b010));
  EXPECT_FALSE(this->rig_.level(0));
  EXPECT_TRUE(this->rig_.level(1));
  EXPECT_TRUE(this->rig_.level(2));
  EXPECT_EQ(this->lines().get(0b111), 0b110U);
}

TYPED_TEST_P(GpioLinesContract, ActiveLowTurnsValuesAndEdgesAbout) {
  this->rig_.drive(4, false);
  GpioLineConfig in = this->input(4, GpioEdges::both);
  in.active_low = true;
  GpioLineConfig out = this->output(2, true);
  out.active_low = true;
  ASSERT_TRUE(this->request({in, out}));
  EXPECT_EQ(this->lines().get(0b01), 0b01U);
  EXPECT_FALSE(this->rig_.level(2));
  ASSERT_TRUE(this->lines().set(0b10, 0));
  EXPECT_TRUE(this->rig_.level(2));
  this->rig_.drive(4, true);
  EXPECT_EQ(this->lines().get(0b01), 0U);
  const auto edges = this->drain();
  ASSERT_EQ(edges.size(), 1U);
  EXPECT_FALSE(edges[0].rising);
}

TYPED_TEST_P(GpioLinesContract, EdgesComeInOrderNumberedFromOne) {
  this->rig_.drive(1, false);
  this->rig_.drive(2, false);
  ASSERT_TRUE(this->request({this->input(1, GpioEdges::both), this->input(2, GpioEdges::both)}));
  const TimeNs before_ns = this->rig_.clock().now_ns();
  this->rig_.drive(1, true);
  this->rig_.drive(2, true);
  this->rig_.drive(1, false);
  const auto edges = this->drain();
  ASSERT_EQ(edges.size(), 3U);
  const std::array<std::uint32_t, 3> offsets{1, 2, 1};
  const std::array<std::uint32_t, 3> line_sequences{1, 1, 2};
  const std::array<bool, 3> rising{true, true, false};
  TimeNs last_ns = before_ns;
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(edges[i].offset, offsets[i]);
    EXPECT_EQ(edges[i].sequence, i + 1);
    EXPECT_EQ(edges[i].line_sequence, line_sequences[i]);
    EXPECT_EQ(edges[i].rising, rising[i]);
    EXPECT_GE(edges[i].time_ns, last_ns);
    last_ns = edges[i].time_ns;
  }
  EXPECT_LE(last_ns, this->rig_.clock().now_ns());
}

TYPED_TEST_P(GpioLinesContract, OnlyTheWatchedEdgesCount) {
  this->rig_.drive(1, false);
  this->rig_.drive(2, false);
  ASSERT_TRUE(
      this->request({this->input(1, GpioEdges::rising), this->input(2, GpioEdges::falling)}));
  for (int i = 0; i < 2; ++i) {
    for (const std::size_t offset : {1U, 2U}) {
      this->rig_.drive(offset, true);
      this->rig_.drive(offset, false);
    }
  }
  const auto edges = this->drain();
  ASSERT_EQ(edges.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(edges[i].rising, edges[i].offset == 1);
    EXPECT_EQ(edges[i].sequence, i + 1);
  }
}

TYPED_TEST_P(GpioLinesContract, FullBufferLosesTheOldestAndTheNumbersTell) {
  this->rig_.drive(1, false);
  ASSERT_TRUE(
      this->request({this->input(1, GpioEdges::both), this->input(2, GpioEdges::both)}, 16));
  constexpr std::uint32_t kEdges = 100;
  for (std::uint32_t i = 0; i < kEdges; ++i) {
    this->rig_.drive(1, i % 2 == 0);
  }
  const auto edges = this->drain();
  ASSERT_GE(edges.size(), 16U);
  ASSERT_LT(edges.size(), kEdges);
  GpioLossCounter loss;
  EXPECT_EQ(loss.saw(edges.front()), kEdges - edges.size());
  for (std::size_t i = 1; i < edges.size(); ++i) {
    EXPECT_EQ(loss.saw(edges[i]), 0U);
  }
  EXPECT_EQ(edges.back().sequence, kEdges);
  EXPECT_EQ(loss.lost() + edges.size(), kEdges);
}

TYPED_TEST_P(GpioLinesContract, SilenceLastsUntilTheDeadline) {
  ASSERT_TRUE(this->request({this->input(1, GpioEdges::both)}));
  std::array<GpioEdgeEvent, 1> one;
  const TimeNs deadline_ns = this->rig_.clock().now_ns() + 2'000'000;
  this->expect_refused(this->lines().read_edges(one, deadline_ns), ErrorCode::timeout);
  EXPECT_GE(this->rig_.clock().now_ns(), deadline_ns);
  this->expect_refused(this->lines().read_edges(one, kNoWait), ErrorCode::timeout);
}

TYPED_TEST_P(GpioLinesContract, PassedDeadlineTakesWhatIsThere) {
  this->rig_.drive(1, false);
  ASSERT_TRUE(this->request({this->input(1, GpioEdges::both)}));
  this->rig_.drive(1, true);
  std::array<GpioEdgeEvent, 4> some;
  EXPECT_EQ(this->lines().read_edges(some, kNoWait), 1U);
}

TYPED_TEST_P(GpioLinesContract, DebouncedLineReportsOnceWhenSettled) {
  this->rig_.drive(1, false);
  GpioLineConfig button = this->input(1, GpioEdges::both);
  button.debounce_us = 20'000;
  ASSERT_TRUE(this->request({button, this->input(2)}));
  const TimeNs before_ns = this->rig_.clock().now_ns();
  for (const bool high : {true, false, true, false, true}) {
    this->rig_.drive(1, high);
  }
  const auto edges = this->drain();
  ASSERT_EQ(edges.size(), 1U);
  EXPECT_TRUE(edges[0].rising);
  EXPECT_GE(edges[0].time_ns, before_ns + 20'000'000);
  EXPECT_EQ(this->lines().get(0b01), 1U);
}

TYPED_TEST_P(GpioLinesContract, ContradictoryRequestsAreRefused) {
  GpioLineConfig output_with_edges = this->output(0);
  output_with_edges.edges = GpioEdges::rising;
  GpioLineConfig output_with_debounce = this->output(0);
  output_with_debounce.debounce_us = 1;
  GpioLineConfig input_with_drive = this->input(0);
  input_with_drive.drive = GpioDrive::open_drain;
  this->expect_refused(this->request({}), ErrorCode::invalid_argument);
  this->expect_refused(this->request({output_with_edges}), ErrorCode::invalid_argument);
  this->expect_refused(this->request({output_with_debounce}), ErrorCode::invalid_argument);
  this->expect_refused(this->request({input_with_drive}), ErrorCode::invalid_argument);
  this->expect_refused(this->request({this->input(1), this->output(1)}),
                       ErrorCode::invalid_argument);
  this->expect_refused(this->request({this->input(1)}, kMaxGpioEdgeBuffer + 1),
                       ErrorCode::invalid_argument);
  this->expect_refused(this->request({this->input(1'000'000)}), ErrorCode::not_found);
  const std::vector<GpioLineConfig> many(kMaxGpioLines + 1);
  this->expect_refused(this->lines().request({.lines = many}), ErrorCode::invalid_argument);
  EXPECT_TRUE(this->request({this->input(0)}));
}

TYPED_TEST_P(GpioLinesContract, HeldLineIsBusyUntilReleased) {
  ASSERT_TRUE(this->request({this->input(1), this->input(2)}));
  this->expect_refused(this->request({this->input(3)}), ErrorCode::invalid_state);
  const std::array overlapping{this->input(3), this->input(2)};
  this->expect_refused(this->rig_.other_lines().request({.lines = overlapping}), ErrorCode::busy);
  // All or none: 3 was not taken.
  const std::array free_line{this->input(3)};
  EXPECT_TRUE(this->rig_.other_lines().request({.lines = free_line}));
  this->rig_.other_lines().release();
  this->lines().release();
  EXPECT_EQ(this->lines().line_count(), 0U);
  EXPECT_TRUE(this->rig_.other_lines().request({.lines = overlapping}));
}

TYPED_TEST_P(GpioLinesContract, NothingWorksWithoutARequest) {
  std::array<GpioEdgeEvent, 1> one;
  this->expect_refused(this->lines().get(1), ErrorCode::invalid_state);
  this->expect_refused(this->lines().set(1, 1), ErrorCode::invalid_state);
  this->expect_refused(this->lines().read_edges(one, kNoWait), ErrorCode::invalid_state);
  this->lines().release();
}

TYPED_TEST_P(GpioLinesContract, MasksNameOnlyWhatWasRequested) {
  ASSERT_TRUE(this->request({this->input(1), this->output(2)}));
  this->expect_refused(this->lines().get(0), ErrorCode::invalid_argument);
  this->expect_refused(this->lines().get(0b100), ErrorCode::invalid_argument);
  this->expect_refused(this->lines().set(0, 0), ErrorCode::invalid_argument);
  this->expect_refused(this->lines().set(0b01, 0), ErrorCode::invalid_argument);
  this->expect_refused(this->lines().set(0b110, 0), ErrorCode::invalid_argument);
  std::array<GpioEdgeEvent, 1> one;
  this->expect_refused(this->lines().read_edges(one, kNoWait), ErrorCode::invalid_state);
}

TYPED_TEST_P(GpioLinesContract, NewRequestCountsFromOneAgain) {
  this->rig_.drive(1, false);
  for (int i = 0; i < 2; ++i) {
    ASSERT_TRUE(this->request({this->input(1, GpioEdges::both), this->input(2, GpioEdges::both)}));
    this->rig_.drive(1, i == 0);
    const auto edges = this->drain();
    ASSERT_EQ(edges.size(), 1U);
    EXPECT_EQ(edges[0].sequence, 1U);
    this->lines().release();
  }
}

REGISTER_TYPED_TEST_SUITE_P(GpioLinesContract, ReadsSeveralLinesAtOnce, SetsOnlyTheLinesInTheMask,
                            ActiveLowTurnsValuesAndEdgesAbout, EdgesComeInOrderNumberedFromOne,
                            OnlyTheWatchedEdgesCount, FullBufferLosesTheOldestAndTheNumbersTell,
                            SilenceLastsUntilTheDeadline, PassedDeadlineTakesWhatIsThere,
                            DebouncedLineReportsOnceWhenSettled, ContradictoryRequestsAreRefused,
                            HeldLineIsBusyUntilReleased, NothingWorksWithoutARequest,
                            MasksNameOnlyWhatWasRequested, NewRequestCountsFromOneAgain);

}  // namespace tactus::hal
