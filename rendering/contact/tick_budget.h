// The tick budget: bounds the computation of the shared proxy in one tick, in cost units.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "rendering/limits.h"
#include "rendering/state_archive.h"

namespace tactus::rendering {

// Costs of the parts of a tick, in cost units. One unit is a sixth of the time that measuring a
// triangle takes (100 ns on a server core of 2020). The values are a least-squares fit to the timed
// ticks of `tactus bench` on the dragon.
//
// A pair of hierarchy boxes costs mostly the time until it arrives from memory. A walk to
// everything near prefetches its next boxes; a sweep cannot.
inline constexpr std::size_t kCostOfBoxPairNear = 1;
inline constexpr std::size_t kCostOfBoxPairInBall = 2;      // of a ball that is free
inline constexpr std::size_t kCostOfBoxPairAlongSweep = 4;  // of a sweep

// A triangle of a leaf in the bounding test, and one that a sweep measures.
inline constexpr std::size_t kCostOfLeafTriangle = 1;
inline constexpr std::size_t kCostOfTriangleSweep = 4;

// Candidates: one measurement, one test against the planes that hold the sphere, and one that
// shortens a sweep. `kTangentsPerUnit` tangent tests cost one unit.
inline constexpr std::size_t kCostOfMeasurement = 6;
inline constexpr std::size_t kCostOfSeparation = 2;
inline constexpr std::size_t kCostOfStop = 8;
inline constexpr std::size_t kTangentsPerUnit = 16;

// The remaining cost of a sub-goal, and of a gathering.
inline constexpr std::size_t kCostOfSubGoal = 8;
inline constexpr std::size_t kCostOfGathering = 25;

// The budget of one tick. Most ticks may spend kUsualTickBudget. Unspent ticks save units, and a
// tick with more to do, such as the first of a contact, may spend what was saved, up to
// kMaxTickBudget in all. A tick that is repeated for shading or textures may spend kMaxTickBudget
// whatever was saved.
class TickBudget {
 public:
  void begin_tick() {
    const std::size_t beyond = spent_ - std::min(spent_, kUsualTickBudget);
    saved_ -= std::min(saved_, beyond * kTicksPerSavedUnit);
    saved_ = std::min(saved_ + 1, kMaxSaved);
    limit_ = std::min(kUsualTickBudget + saved_ / kTicksPerSavedUnit, kMaxTickBudget);
    spent_ = 0;
  }

  // Returns true if the cost so far can be spent once more within kMaxTickBudget.
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
