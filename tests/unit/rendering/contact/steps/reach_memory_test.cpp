// The candidates within reach, for planes whose distances are written down here.
#include "rendering/contact/reach_memory.h"

#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <span>
#include <vector>

namespace tactus::rendering {
namespace {

// Candidates behind planes across x: candidate i is 10 i mm from the origin, and within reach at
// 25 mm.
class ReachMemoryTest : public ::testing::Test {
 protected:
  using Numbers = std::vector<std::uint16_t>;
  static constexpr std::size_t kSize = 8;
  static constexpr double kReach_m = 0.025;
  static constexpr ReachMemory::Key kFirst{.place = 1, .gathering = 1};

  ReachMemoryTest() {
    reach_->bounds().start(Vec3::Zero(), kReach_m);
    for (std::size_t i = 0; i < kSize; ++i) {
      reach_->bounds().set_at_origin(i, {1.0F, 0.0F, 0.0F}, 0.01 * static_cast<double>(i), 0.0);
    }
  }
  static Numbers numbers(std::span<const std::uint16_t> found) {
    return {found.begin(), found.end()};
  }

  std::unique_ptr<ReachMemory> reach_ = std::make_unique<ReachMemory>();
};

TEST_F(ReachMemoryTest, IsValidForItsOwnPositionAndGatheringOnly) {
  EXPECT_FALSE(reach_->knows(kFirst));
  reach_->find_here(kSize, Vec3::Zero(), kFirst);
  EXPECT_TRUE(reach_->knows(kFirst));
  EXPECT_EQ(numbers(reach_->here()), (Numbers{0, 1, 2}));
  EXPECT_FALSE(reach_->knows({.place = 2, .gathering = 1}));
  EXPECT_FALSE(reach_->knows({.place = 1, .gathering = 2}));
  reach_->forget();
  EXPECT_FALSE(reach_->knows(kFirst));
}

TEST_F(ReachMemoryTest, ASearchElsewhereLeavesTheOnesHere) {
  reach_->find_here(kSize, Vec3::Zero(), kFirst);
  EXPECT_EQ(numbers(reach_->find_there(kSize, {-0.02, 0.0, 0.0}, 0.0)), (Numbers{0, 1, 2, 3, 4}));
  EXPECT_EQ(numbers(reach_->find_there(kSize, {-0.02, 0.0, 0.0}, 0.01)),
            (Numbers{0, 1, 2, 3, 4, 5}));
  EXPECT_TRUE(reach_->knows(kFirst));
  EXPECT_EQ(numbers(reach_->here()), (Numbers{0, 1, 2}));
}

TEST_F(ReachMemoryTest, AMoveThereLeavesOutWhatWasMeasuredOutOfReachSince) {
  constexpr ReachMemory::Key kNext{.place = 2, .gathering = 1};
  const Vec3 end{-0.02, 0.0, 0.0};
  reach_->find_there(kSize, end, 0.0);
  reach_->bounds().set_at_origin(1, {1.0F, 0.0F, 0.0F}, 0.06, 0.0);
  reach_->move_there(end, kNext);
  EXPECT_TRUE(reach_->knows(kNext));
  EXPECT_EQ(numbers(reach_->here()), (Numbers{0, 2, 3, 4}));
}

TEST_F(ReachMemoryTest, IsSavedAndRestored) {
  for (const bool is_known : {true, false}) {
    reach_->find_here(kSize, Vec3::Zero(), kFirst);
    if (!is_known) {
      reach_->forget();
    }
    std::array<std::byte, 64> bytes{};
    StateArchive writer = StateArchive::writer(bytes);
    reach_->transfer(writer, kSize, kFirst);
    StateArchive reader = StateArchive::reader(std::span(bytes).first(writer.size()));
    const auto other = std::make_unique<ReachMemory>();
    other->transfer(reader, kSize, kFirst);
    ASSERT_TRUE(reader.good() && reader.at_end());
    EXPECT_EQ(other->knows(kFirst), is_known);
    EXPECT_EQ(numbers(other->here()), is_known ? numbers(reach_->here()) : Numbers{});
  }
}

TEST_F(ReachMemoryTest, ANumberBeyondTheCandidatesIsRefused) {
  reach_->find_here(kSize, Vec3::Zero(), kFirst);
  std::array<std::byte, 64> bytes{};
  StateArchive writer = StateArchive::writer(bytes);
  reach_->transfer(writer, kSize, kFirst);
  StateArchive reader = StateArchive::reader(std::span(bytes).first(writer.size()));
  reach_->transfer(reader, 2, kFirst);
  EXPECT_FALSE(reader.good());
}

}  // namespace
}  // namespace tactus::rendering
