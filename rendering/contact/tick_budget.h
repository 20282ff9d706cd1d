// How much the shared proxy may do in a tick, and what counts how much toward it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "rendering/limits.h"
#include "rendering/state/state_archive.h"

namespace tactus::rendering {

// In sixths of the time that it takes to measure a triangle (100 ns on a server core of 2020).
// Fitted by least squares to the 20,000 ticks of `tactus bench` on the dragon, each timed and its
// parts counted.
//
// A pair of boxes of a hierarchy, most of whose time goes by until they come from memory. A walk to
// everything that is near knows the next ones long before their turn, a cast does not.
inline constexpr std::size_t kCostOfBoxPairNear = 1;
inline constexpr std::size_t kCostOfBoxPairInBall = 2;      // of a ball that is free
inline constexpr std::size_t kCostOfBoxPairAlongSweep = 4;  // of a cast

// A triangle of a leaf that is looked at, and one of a cast that may be met.
inline constexpr std::size_t kCostOfLeafTriangle = 1;
inline constexpr std::size_t kCostOfTriangleSweep = 4;

// Candidates: one that is measured, one that is held against the planes that hold the sphere, one
// that stops it on its way; and how many tangents are asked in a unit.
inline constexpr std::size_t kCostOfMeasurement = 6;
inline constexpr std::size_t kCostOfSeparation = 2;
inline constexpr std::size_t kCostOfStop = 8;
inline constexpr std::size_t kTangentsPerUnit = 16;

// The rest of a sub-goal, and of a gathering.
inline constexpr std::size_t kCostOfSubGoal = 8;
inline constexpr std::size_t kCostOfGathering = 25;

// A tick's work. Most ticks end after kUsualTickBudget; one that has more to do, such as the first
// of a contact, may go on to kMaxTickBudget with what is saved, and one whose way is gone again,
// for the sake of shading and textures, whatever is saved.
class TickBudget {
 public:
  void begin_tick() {
    const std::size_t beyond = spent_ - std::min(spent_, kUsualTickBudget);
    saved_ -= std::min(saved_, beyond * kTicksPerSavedUnit);
    saved_ = std::min(saved_ + 1, kMaxSaved);
    limit_ = std::min(kUsualTickBudget + saved_ / kTicksPerSavedUnit, kMaxTickBudget);
    spent_ = 0;
  }

  // What was done is done once more, or less.
  [[nodiscard]] bool can_repeat() const { return 2 * spent_ <= kMaxTickBudget; }
  void allow_repeat() { limit_ = kMaxTickBudget; }

  void spend(std::size_t cost) { spent_ += cost; }
  [[nodiscard]] std::size_t spent() const { return spent_; }
  [[nodiscard]] std::size_t left() const { return limit_ - std::min(spent_, limit_); }
  [[nodiscard]] bool is_exhausted() const { return spent_ > limit_; }

  void transfer(StateArchive& archive);

 private:
  static constexpr std::size_t kMaxSaved = kMaxSavedBudget * kTicksPerSavedUnit;

  std::size_t spent_ = 0;
  std::size_t limit_ = kMaxTickBudget;
  std::size_t saved_ = kMaxSaved;  // units times kTicksPerSavedUnit
};

}  // namespace tactus::rendering
