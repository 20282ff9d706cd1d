// The tick budget: bounds the computation of a tick, in cost units. Time itself is no bound: it
// differs from run to run, and a recorded tick must give the same bits again. The budget follows
// from the tick's period (World::set_tick). It is a last resort: ordinary touching spends a small
// part of it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "rendering/limits.h"

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

// A triangle that feature_walk measures, and a potential field. `kFormulaStepsPerUnit` instructions
// of an implicit surface's formula cost one unit.
inline constexpr std::size_t kCostOfFeatureVisit = 3;
inline constexpr std::size_t kCostOfField = 64;
inline constexpr std::size_t kFormulaStepsPerUnit = 2;

// A goal that is put on the round walls of a primitive (contact/round_walls.h).
inline constexpr std::size_t kCostOfRoundWalls = 20;

// The remaining cost of a sub-goal, and of a gathering.
inline constexpr std::size_t kCostOfSubGoal = 8;
inline constexpr std::size_t kCostOfGathering = 25;

// Moving the objects, before the first tool: an object with its pose, and of a mesh that deforms
// `kVertexWavesPerUnit` vertices of a wave, `kVertexStepsPerUnit` steps of vertices,
// `kVertexLongStepsPerUnit` more of a mesh in which some step is cut, and `kRefitsPerUnit` boxes
// drawn anew. They are the instructions by callgrind, rounded up to parts of a unit.
inline constexpr std::size_t kCostOfMover = 8;
inline constexpr std::size_t kVertexWavesPerUnit = 6;
inline constexpr std::size_t kVertexStepsPerUnit = 10;
inline constexpr std::size_t kVertexLongStepsPerUnit = 2;
inline constexpr std::size_t kRefitsPerUnit = 2;

// An effect on one tool.
inline constexpr std::size_t kCostOfEffect = 4;

// A layer of tissue, for a needle that is in it or near it.
inline constexpr std::size_t kCostOfNeedleLayer = 12;

// The instructions of a unit, by callgrind: those of 3,000 ticks on the dragon over the units that
// they spent.
inline constexpr double kInstructionsPerUnit = 110.0;

// Returns the cost units that so many instructions pay for.
constexpr std::size_t units_of(double instructions) {
  return static_cast<std::size_t>(instructions / kInstructionsPerUnit);
}

// Returns the instructions that so many cost units stand for.
constexpr double instructions_of(std::size_t units) {
  return kInstructionsPerUnit * static_cast<double>(units);
}

// Returns the instructions that a tick of this period may take, unless someone says otherwise.
constexpr double default_tick_instructions(double tick_s) {
  return std::max(kTickInstructions_per_s * tick_s, kLeastTickInstructions);
}

// The budget of one tool in one tick. World shares a tick's budget out among the tools.
class TickBudget {
 public:
  // Begins a tick that may spend `limit` units.
  void begin_tick(std::size_t limit) {
    limit_ = limit;
    spent_ = 0;
  }

  // Returns true if the cost so far can be spent once more within the limit.
  [[nodiscard]] bool can_repeat() const { return 2 * spent_ <= limit_; }

  // Adds a cost. Spending never fails: the code that spends asks is_exhausted() where it can stop.
  void spend(std::size_t cost) { spent_ += cost; }
  // Returns the units spent in this tick, and those that are left of its limit.
  [[nodiscard]] std::size_t spent() const { return spent_; }
  [[nodiscard]] std::size_t left() const { return limit_ - std::min(spent_, limit_); }
  // Returns true if the tick has spent more than its limit.
  [[nodiscard]] bool is_exhausted() const { return spent_ > limit_; }

 private:
  // The units spent in this tick, and the most that it may spend.
  std::size_t spent_ = 0;
  std::size_t limit_ = 0;
};

}  // namespace tactus::rendering
