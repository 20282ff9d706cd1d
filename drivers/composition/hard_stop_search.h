// Finds a joint's hard stop. It detects a joint that does not move, an obstacle and a wrong sign.
// It has no input or output. All values are in the joint's units: rad or m, N m or N.
//
//   approach    pushes toward the stop until the joint stands
//   back off    moves away a little. A joint that stood at the stop from the start moves here
//   again       comes back. A stop is in the same place, a hand is not
//   cross       moves to the other side. An obstacle before the stop leaves less free travel than
//               the joint's range has
//
// A travel that does not fit ends the search with a HomingFailure and no effort. Every move is
// bounded in effort, speed, travel and time.
#pragma once

#include <cstdint>

#include "drivers/composition/search_move.h"
#include "hal/clock.h"

namespace tactus::drivers {

// The limits of the search, in the joint's units.
struct HardStopLimits {
  double effort = 0.0;      // its sign is the direction to the stop
  double speed = 0.5;       // of the moves
  double range = 0.0;       // free travel from the stop to the other limit; infinite: unknown
  double min_travel = 0.0;  // free travel that must be seen; 0: kRangeShare of the range
  hal::TimeNs time_ns = 0;  // for each move
};

// The search of one joint, tick by tick.
class HardStopSearch {
 public:
  // The share of the range that must be free. It is below 1 because the limits are not exact and
  // stops give a little.
  static constexpr double kRangeShare = 0.98;
  // After so many ranges of travel without a stop, the range or the encoder's scale is wrong.
  static constexpr double kMostRanges = 2.0;

  HardStopSearch() = default;
  explicit HardStopSearch(const HardStopLimits& limits);

  // Starts the search at this position.
  void begin(double position, hal::TimeNs now_ns);
  // Advances the search by one tick.
  void advance(double position, double velocity, hal::TimeNs now_ns);
  // Replaces `advance` in a tick without a fresh sample.
  void skip(hal::TimeNs now_ns) { move_.skip(now_ns); }

  // Returns the effort for the motor now, N m or N at the joint; 0 when done or failed.
  [[nodiscard]] double effort() const;
  [[nodiscard]] HomingFailure failure() const { return failure_; }
  [[nodiscard]] bool is_done() const { return phase_ == Phase::done; }
  // Returns the stop in the coordinate of `position`. Valid once is_done().
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
  double way_ = 1.0;  // 1 or -1, toward the stop
  double min_travel_ = 0.0;
  double back_off_ = 0.0;    // length of the move away from the stop
  double same_place_ = 0.0;  // largest difference of the two approaches
  SearchMove move_;
  Phase phase_ = Phase::approach;
  HomingFailure failure_ = HomingFailure::none;
  double stop_ = 0.0;
  bool moved_ = false;  // the joint moved in the first approach
};

}  // namespace tactus::drivers
