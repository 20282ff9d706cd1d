// Finds a joint's hard stop and tells it from a joint that does not move, from an obstacle and from
// a wrong sign. No input or output.
//
//   approach    pushes toward the stop until the joint stands
//   back off    moves away a little: a joint that stood at the stop from the start moves here
//   again       comes back: a stop is in the same place, a hand is not
//   cross       moves to the other side: an obstacle before the stop leaves less free travel than
//               the joint's range has
//
// A travel that is not as it must be ends the search with a HomingFailure and no effort. Every move
// is bounded in effort, speed, travel and time.
#pragma once

#include <cstdint>

#include "drivers/search_move.h"
#include "hal/clock.h"

namespace tactus::drivers {

struct HardStopLimits {
  double effort = 0.0;      // signed: the way to the stop
  double speed = 0.5;       // of the moves
  double range = 0.0;       // free travel from the stop to the other limit; infinite: unknown
  double min_travel = 0.0;  // free travel that must be seen; 0: kRangeShare of the range
  hal::TimeNs time_ns = 0;  // for each move
};

class HardStopSearch {
 public:
  // Of the range: the limits are known no better, and stops give a little.
  static constexpr double kRangeShare = 0.98;
  // More travel than so many ranges without a stop: the range or the encoder's scale is wrong.
  static constexpr double kMostRanges = 2.0;

  HardStopSearch() = default;
  explicit HardStopSearch(const HardStopLimits& limits);

  void begin(double position, hal::TimeNs now_ns);
  void advance(double position, double velocity, hal::TimeNs now_ns);
  void skip(hal::TimeNs now_ns) { move_.skip(now_ns); }

  [[nodiscard]] double effort() const;
  [[nodiscard]] HomingFailure failure() const { return failure_; }
  [[nodiscard]] bool is_done() const { return phase_ == Phase::done; }
  // Where the stop is, as `position` counts; valid once it is done.
  [[nodiscard]] double stop() const { return stop_; }

 private:
  enum class Phase : std::uint8_t { approach, back_off, turn, again, cross, rest, done };

  void enter(Phase phase, double way, double position, hal::TimeNs now_ns);
  void approach(double position, hal::TimeNs now_ns);
  void back_off(double position, hal::TimeNs now_ns);
  void come_again(double position, hal::TimeNs now_ns);
  void cross(double position, hal::TimeNs now_ns);
  void fail(HomingFailure failure);

  HardStopLimits limits_;
  double way_ = 1.0;  // toward the stop
  double min_travel_ = 0.0;
  double back_off_ = 0.0;    // how far
  double same_place_ = 0.0;  // two approaches may differ by so much
  SearchMove move_;
  Phase phase_ = Phase::approach;
  HomingFailure failure_ = HomingFailure::none;
  double stop_ = 0.0;
  bool moved_ = false;  // in the first approach
};

}  // namespace tactus::drivers
