// An encoder turned at random, its edges read now and then. The count decoded from the edges must
// be the true one as long as the sequence numbers show no gap, and a gap must show whenever it is
// not.

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "hal/simulated/gpio_lines.h"
#include "tests/unit/hal/random.h"

namespace tactus::hal {
namespace {

constexpr std::uint32_t kA = 4;
constexpr std::uint32_t kB = 9;
constexpr std::size_t kBuffer = 32;

// The encoder: a position, and the Gray code of its two lowest bits on the pins.
class Encoder {
 public:
  explicit Encoder(SimulatedGpioChip& chip) : chip_(chip) {}
  void step(int direction) {
    position_ += direction;
    const auto phase = static_cast<unsigned>(position_) % 4U;
    chip_.drive(kA, phase == 1 || phase == 2);
    chip_.drive(kB, phase == 2 || phase == 3);
  }
  std::int64_t position() const { return position_; }

 private:
  SimulatedGpioChip& chip_;
  std::int64_t position_ = 0;
};

// Every edge is one count: forward if, after an edge on A, the lines differ, or after one on B,
// they agree.
class Decoder {
 public:
  void see(const GpioEdgeEvent& event) {
    bool& line = event.offset == kA ? a_ : b_;
    line = event.rising;
    const bool forward = (a_ != b_) == (event.offset == kA);
    count_ += forward ? 1 : -1;
  }
  std::int64_t count() const { return count_; }

  void start_again(std::int64_t count, bool a, bool b) {
    count_ = count;
    a_ = a;
    b_ = b;
  }

 private:
  bool a_ = false;
  bool b_ = false;
  std::int64_t count_ = 0;
};

TEST(SimulatedGpioQuadrature, LossAlwaysShowsAsAGapAndNoGapMeansTheTrueCount) {
  Random random(77);
  SimulatedClock clock;
  SimulatedGpioChip chip(clock);
  SimulatedGpioLines lines(chip);
  const std::array config{GpioLineConfig{.offset = kA, .edges = GpioEdges::both},
                          GpioLineConfig{.offset = kB, .edges = GpioEdges::both}};
  ASSERT_TRUE(lines.request({.lines = config, .edge_buffer = kBuffer}));
  Encoder encoder(chip);
  Decoder decoder;
  GpioLossCounter loss;
  std::vector<GpioEdgeEvent> events(kBuffer);
  std::uint64_t whole = 0;
  std::uint64_t overflowed = 0;
  for (int round = 0; round < 5000; ++round) {
    const std::size_t steps = random.below(random.one_in(4) ? 3 * kBuffer : kBuffer);
    const int direction = random.one_in(2) ? 1 : -1;
    for (std::size_t i = 0; i < steps; ++i) {
      clock.advance_by(1000);
      encoder.step(random.one_in(5) ? -direction : direction);
    }
    const std::uint64_t lost_before = loss.lost();
    TimeNs last_ns = 0;
    if (const auto count = lines.read_edges(events, kNoWait)) {
      for (const GpioEdgeEvent& event : std::span(events).first(*count)) {
        loss.saw(event);
        decoder.see(event);
        ASSERT_GT(event.time_ns, last_ns);
        last_ns = event.time_ns;
      }
    }
    const std::uint64_t lost = loss.lost() - lost_before;
    ASSERT_EQ(lost, steps > kBuffer ? steps - kBuffer : 0) << round;
    if (lost == 0) {
      ASSERT_EQ(decoder.count(), encoder.position()) << round;
      ++whole;
    } else {
      ++overflowed;
      decoder.start_again(encoder.position(), chip.level(kA), chip.level(kB));
    }
  }
  EXPECT_GT(whole, 1000U);
  EXPECT_GT(overflowed, 500U);
}

}  // namespace
}  // namespace tactus::hal
