// A needle that is saved at any moment and restored goes on to the same bits.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <vector>

#include "tests/unit/rendering/needle/needle_bench.h"

namespace tactus::rendering {
namespace {

constexpr int kSavedTicks = 12000;

// In and out of three layers twice, beside the first channel the second time.
Vec3 path_W(int tick) {
  const double s = tick * 1e-3;
  return {tick > kSavedTicks / 2 ? 0.003 : 1e-4 * std::sin(3.0 * s),
          0.002 - 0.02 * (1.0 - std::cos(2.0 * std::numbers::pi * s / 6.0)),
          1e-4 * std::sin(7.0 * s)};
}

NeedleBench three_layers() {
  return NeedleBench(
      {tissue_block(0.0, 0), tissue_block(-0.008, 1, -0.19), tissue_block(-0.02, 2, -0.18)},
      {balanced_tissue(0.6), balanced_tissue(1.0), balanced_tissue(1.4)},
      {.length_m = 0.1, .width_m = 1e-3});
}

TEST(NeedleState, GoesOnAlikeFromAnyMoment) {
  for (int saved_at = 150; saved_at < kSavedTicks; saved_at += 611) {
    NeedleBench first = three_layers();
    for (int i = 0; i <= saved_at; ++i) {
      first.to(path_W(i));
    }
    auto room = std::make_unique<std::array<std::byte, 1U << 16U>>();
    StateArchive writer = StateArchive::writer(*room);
    first.touch().transfer(writer);
    ASSERT_TRUE(writer.good());
    NeedleBench second = three_layers();
    for (int i = 0; i < 3000; ++i) {
      second.to(path_W(i));  // somewhere else
    }
    StateArchive reader = StateArchive::reader(std::span(*room).first(writer.size()));
    second.touch().transfer(reader);
    ASSERT_TRUE(reader.good() && reader.at_end());
    second.stand_at(path_W(saved_at));
    for (int i = saved_at + 1; i < std::min(saved_at + 2500, kSavedTicks); ++i) {
      ASSERT_EQ(second.to(path_W(i)).force_W, first.to(path_W(i)).force_W) << saved_at << " " << i;
    }
    EXPECT_EQ(second.touch().energy().crack_m2, first.touch().energy().crack_m2);
  }
}

TEST(NeedleState, RefusesBytesThatMakeNoNeedle) {
  NeedleBench bench = three_layers();
  for (int i = 0; i < 3000; ++i) {
    bench.to(path_W(i));
  }
  std::vector<std::byte> bytes(1U << 16U);
  StateArchive writer = StateArchive::writer(bytes);
  bench.touch().transfer(writer);
  bytes.resize(writer.size());
  bytes.pop_back();
  StateArchive cut = StateArchive::reader(bytes);
  bench.touch().transfer(cut);
  EXPECT_FALSE(cut.good());
  // All bits set are no numbers.
  std::vector<std::byte> ones(writer.size(), std::byte{0xff});
  StateArchive bad = StateArchive::reader(ones);
  bench.touch().transfer(bad);
  EXPECT_FALSE(bad.good());
}

}  // namespace
}  // namespace tactus::rendering
