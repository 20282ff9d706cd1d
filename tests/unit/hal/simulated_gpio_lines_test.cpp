#include "hal/simulated/gpio_lines.h"

#include "tests/unit/hal/gpio_lines_contract.h"

namespace tactus::hal {
namespace {

struct SimulatedGpioRig {
  GpioLines& lines() { return first; }
  GpioLines& other_lines() { return second; }
  Clock& clock() { return simulated; }
  void drive(std::size_t offset, bool high) { chip.drive(offset, high); }
  bool level(std::size_t offset) const { return chip.level(offset); }

  SimulatedClock simulated;
  SimulatedGpioChip chip{simulated, 32};
  SimulatedGpioLines first{chip};
  SimulatedGpioLines second{chip};
};

INSTANTIATE_TYPED_TEST_SUITE_P(Simulated, GpioLinesContract, SimulatedGpioRig);

constexpr TimeNs kGpioUs = 1000;

class SimulatedGpio : public ::testing::Test {
 protected:
  void request(std::initializer_list<GpioLineConfig> configs) {
    ASSERT_TRUE(lines_.request({.lines = std::span(configs.begin(), configs.size())}));
  }
  std::vector<GpioEdgeEvent> edges() {
    std::vector<GpioEdgeEvent> events(lines_.edges_waiting());
    if (!events.empty()) {
      EXPECT_EQ(lines_.read_edges(events, kNoWait), events.size());
    }
    return events;
  }

  SimulatedClock clock_{0};
  SimulatedGpioChip chip_{clock_, 16};
  SimulatedGpioLines lines_{chip_};
};

TEST_F(SimulatedGpio, OpenInputFollowsItsPull) {
  request({{.offset = 0, .bias = GpioBias::pull_up},
           {.offset = 1, .bias = GpioBias::pull_down},
           {.offset = 2, .bias = GpioBias::disabled}});
  EXPECT_EQ(lines_.get(0b111), 0b001U);
  chip_.drive(0, false);
  EXPECT_EQ(lines_.get(0b111), 0U);
  chip_.leave_open(0);
  EXPECT_EQ(lines_.get(0b111), 0b001U);
}

TEST_F(SimulatedGpio, OpenDrainPullsDownAndOtherwiseLetsGo) {
  request({{.offset = 0,
            .direction = GpioDirection::output,
            .bias = GpioBias::pull_up,
            .drive = GpioDrive::open_drain,
            .initial_active = true},
           {.offset = 1, .direction = GpioDirection::output, .drive = GpioDrive::open_source}});
  EXPECT_TRUE(chip_.level(0));
  chip_.drive(0, false);
  EXPECT_FALSE(chip_.level(0));
  EXPECT_EQ(lines_.get(0b01), 0U);
  chip_.leave_open(0);
  ASSERT_TRUE(lines_.set(0b01, 0));
  EXPECT_FALSE(chip_.level(0));
  chip_.drive(1, true);
  EXPECT_TRUE(chip_.level(1));
}

TEST_F(SimulatedGpio, PushPullOutputWinsOverTheOutside) {
  request({{.offset = 0, .direction = GpioDirection::output}});
  chip_.drive(0, true);
  EXPECT_FALSE(chip_.level(0));
  lines_.release();
  EXPECT_TRUE(chip_.level(0));
}

TEST_F(SimulatedGpio, EdgeCarriesTheTimeItHappened) {
  request({{.offset = 3, .edges = GpioEdges::both}});
  clock_.advance_to(700);
  chip_.drive(3, true);
  clock_.advance_to(900);
  chip_.drive(3, true);
  const auto seen = edges();
  ASSERT_EQ(seen.size(), 1U);
  EXPECT_EQ(seen[0].time_ns, 700);
}

TEST_F(SimulatedGpio, DebounceStartsAgainAtEveryBounce) {
  request({{.offset = 3, .edges = GpioEdges::both, .debounce_us = 100}});
  chip_.drive(3, true);
  clock_.advance_to(90 * kGpioUs);
  chip_.drive(3, false);
  clock_.advance_to(95 * kGpioUs);
  chip_.drive(3, true);
  clock_.advance_to(194 * kGpioUs);
  EXPECT_EQ(lines_.get(1), 0U);
  EXPECT_TRUE(edges().empty());
  clock_.advance_to(1000 * kGpioUs);
  const auto seen = edges();
  ASSERT_EQ(seen.size(), 1U);
  EXPECT_EQ(seen[0].time_ns, 195 * kGpioUs);
  EXPECT_EQ(lines_.get(1), 1U);
}

TEST_F(SimulatedGpio, GlitchShorterThanTheDebounceLeavesNoTrace) {
  request({{.offset = 3, .edges = GpioEdges::both, .debounce_us = 100}});
  chip_.drive(3, true);
  clock_.advance_to(99 * kGpioUs);
  chip_.drive(3, false);
  clock_.advance_to(1000 * kGpioUs);
  EXPECT_TRUE(edges().empty());
}

TEST_F(SimulatedGpio, WaitForAnEdgeEndsWhenTheLineSettles) {
  request({{.offset = 3, .edges = GpioEdges::both, .debounce_us = 100}});
  chip_.drive(3, true);
  std::array<GpioEdgeEvent, 1> one;
  EXPECT_EQ(lines_.read_edges(one, 1000 * kGpioUs), 1U);
  EXPECT_EQ(clock_.now_ns(), 100 * kGpioUs);
}

TEST_F(SimulatedGpio, EdgesTheInterruptMissedShowAsAGap) {
  request({{.offset = 1, .edges = GpioEdges::both}, {.offset = 2, .edges = GpioEdges::both}});
  chip_.drive(1, true);
  lines_.lose_next_edges(2);
  chip_.drive(2, true);
  chip_.drive(1, false);
  chip_.drive(2, false);
  const auto seen = edges();
  ASSERT_EQ(seen.size(), 2U);
  GpioLossCounter loss;
  EXPECT_EQ(loss.saw(seen[0]), 0U);
  EXPECT_EQ(loss.saw(seen[1]), 2U);
}

TEST_F(SimulatedGpio, BufferIsRoundedUpToAPowerOfTwoAsInTheKernel) {
  const std::array config{GpioLineConfig{.offset = 1, .edges = GpioEdges::both}};
  ASSERT_TRUE(lines_.request({.lines = config, .edge_buffer = 9}));
  for (int i = 0; i < 40; ++i) {
    chip_.drive(1, i % 2 == 0);
  }
  EXPECT_EQ(lines_.edges_waiting(), 16U);
}

TEST_F(SimulatedGpio, RemovedChipIsDisconnected) {
  request(
      {{.offset = 0, .direction = GpioDirection::output}, {.offset = 1, .edges = GpioEdges::both}});
  chip_.remove();
  std::array<GpioEdgeEvent, 1> one;
  EXPECT_EQ(lines_.get(1).error().code, ErrorCode::disconnected);
  EXPECT_EQ(lines_.set(1, 1).error().code, ErrorCode::disconnected);
  EXPECT_EQ(lines_.read_edges(one, kForever).error().code, ErrorCode::disconnected);
  lines_.release();
  const std::array config{GpioLineConfig{.offset = 5}};
  EXPECT_EQ(lines_.request({.lines = config}).error().code, ErrorCode::disconnected);
}

TEST(GpioLossCounter, CountsAcrossTheWrapOfTheSequence) {
  GpioLossCounter loss;
  EXPECT_EQ(loss.saw({.sequence = 0xFFFF'FFFF}), 0xFFFF'FFFEU);
  EXPECT_EQ(loss.saw({.sequence = 0}), 0U);
  EXPECT_EQ(loss.saw({.sequence = 2}), 1U);
  EXPECT_EQ(loss.lost(), 0xFFFF'FFFFU);
}

}  // namespace
}  // namespace tactus::hal
