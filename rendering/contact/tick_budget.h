// The tick budget: bounds the computation of the shared proxy in one tick, in cost units. Time
// itself is no bound: it differs from run to run, and a recorded tick must give the same bits
// again. CandidateSet owns the budget; gathering, measuring and sweeping spend it.
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
//
//   saved <- min(max(saved - beyond * kTicksPerSavedUnit, 0) + 1, kMaxSaved)
//   limit <- min(kUsualTickBudget + saved / kTicksPerSavedUnit, kMaxTickBudget)
//
// `saved` is in tenths of a unit, one per tick; `beyond` is what the last tick spent over
// kUsualTickBudget. So a tick that spends 100 units more is paid for by 1,000 later ones, and the
// time of all but few ticks is that of kUsualTickBudget.
class TickBudget {
 public:
  // Begins a tick: pays for the last one from what was saved, and sets the limit of this one.
  void begin_tick() {
    const std::size_t beyond = spent_ - std::min(spent_, kUsualTickBudget);
    saved_ -= std::min(saved_, beyond * kTicksPerSavedUnit);
    saved_ = std::min(saved_ + 1, kMaxSaved);
    limit_ = std::min(kUsualTickBudget + saved_ / kTicksPerSavedUnit, kMaxTickBudget);
    spent_ = 0;
  }

  // Returns true if the cost so far can be spent once more within kMaxTickBudget.
  [[nodiscard]] bool can_repeat() const { return 2 * spent_ <= kMaxTickBudget; }
  // Raises the tick's limit to kMaxTickBudget, for a repetition of the tick.
  void allow_repeat() { limit_ = kMaxTickBudget; }

  // Adds a cost. Spending never fails: the code that spends asks is_exhausted() where it can stop.
  void spend(std::size_t cost) { spent_ += cost; }
  // Returns the units spent in this tick, and those that are left of its limit.
  [[nodiscard]] std::size_t spent() const { return spent_; }
  [[nodiscard]] std::size_t left() const { return limit_ - std::min(spent_, limit_); }
  // Returns true if the tick has spent more than its limit.
  [[nodiscard]] bool is_exhausted() const { return spent_ > limit_; }

  // Saves the budget to the archive, or restores it.
  void transfer(StateArchive& archive);

 private:
  static constexpr std::size_t kMaxSaved = kMaxSavedBudget * kTicksPerSavedUnit;

  // The units spent in this tick, and the most that it may spend. A new budget has all savings.
  std::size_t spent_ = 0;
  std::size_t limit_ = kMaxTickBudget;
  // The savings in units times kTicksPerSavedUnit.
  std::size_t saved_ = kMaxSaved;
};

}  // namespace tactus::rendering
