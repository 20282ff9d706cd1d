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
inline constexpr std::size_t kWorkOfBoxesNear = 1;
inline constexpr std::size_t kWorkOfBoxesAbout = 2;  // of a ball that is free
inline constexpr std::size_t kWorkOfBoxesAlong = 4;  // of a cast

// A triangle of a leaf that is looked at, and one of a cast that may be met.
inline constexpr std::size_t kWorkOfALook = 1;
inline constexpr std::size_t kWorkOfAMeeting = 4;

// Candidates: one that is measured, one that is held against the planes that hold the sphere, one
// that stops it on its way; and how many tangents are asked in a unit.
inline constexpr std::size_t kWorkOfAMeasurement = 6;
inline constexpr std::size_t kWorkOfASeparation = 2;
inline constexpr std::size_t kWorkOfAStop = 8;
inline constexpr std::size_t kTangentsAUnit = 16;

// The rest of a sub-goal, and of a gathering.
inline constexpr std::size_t kWorkOfASubGoal = 8;
inline constexpr std::size_t kWorkOfAGathering = 25;

// A tick's work. Most ticks end after kUsualWork; one that has more to do, such as the first of a
// contact, may go on to kMaxWork with what is saved, and one whose way is gone again, for the sake
// of shading and textures, whatever is saved.
class Work {
 public:
  void begin_tick() {
    const std::size_t beyond = done_ - std::min(done_, kUsualWork);
    saved_ -= std::min(saved_, beyond * kTicksToSaveAUnit);
    saved_ = std::min(saved_ + 1, kMostSaved);
    most_ = std::min(kUsualWork + saved_ / kTicksToSaveAUnit, kMaxWork);
    done_ = 0;
  }

  // What was done is done once more, or less.
  [[nodiscard]] bool can_repeat() const { return 2 * done_ <= kMaxWork; }
  void repeat() { most_ = kMaxWork; }

  void add(std::size_t units) { done_ += units; }
  [[nodiscard]] std::size_t done() const { return done_; }
  [[nodiscard]] std::size_t left() const { return most_ - std::min(done_, most_); }
  [[nodiscard]] bool is_over() const { return done_ > most_; }

  void transfer(StateArchive& archive);

 private:
  static constexpr std::size_t kMostSaved = kMostSavedWork * kTicksToSaveAUnit;

  std::size_t done_ = 0;
  std::size_t most_ = kMaxWork;
  std::size_t saved_ = kMostSaved;  // units times kTicksToSaveAUnit
};

}  // namespace tactus::rendering
