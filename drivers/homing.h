// How one joint finds out where it is: its reference.
//
// Until then its encoder counts from wherever it woke up. `absolute` needs nothing. The others wait
// for the controller's `home`:
//   board        the board finds its own reference (the Falcon's homing bits)
//   known_pose   the user holds the joint still in a known place for kStill_ns while asking for
//                home
//   index        the encoder's index pulse is at a known place; the user moves the joint over it,
//                or the motor does, if search_effort is not 0
//   hard_stop    the motor pushes the joint, gently, against a stop at a known place, and shows
//                that it is the stop (drivers/hard_stop_search.h)
// A motor that searches pushes with search_effort at most, rising slowly, damped to search_speed;
// each of its moves takes no longer than `time_limit_s`.
#pragma once

#include <cstdint>
#include <limits>

#include "drivers/axis.h"
#include "drivers/field_error.h"
#include "drivers/hard_stop_search.h"
#include "drivers/search_move.h"
#include "drivers/transmission.h"
#include "hal/clock.h"

namespace tactus::drivers {

enum class ReferenceKind : std::uint8_t { absolute, board, known_pose, index, hard_stop };

struct Reference {
  ReferenceKind kind = ReferenceKind::absolute;
  double position = 0.0;       // of the joint there, rad or m
  double search_effort = 0.0;  // N m or N at the joint, signed: the way it searches; 0 by hand
  double search_speed = 0.5;   // rad/s or m/s, above 0, to 100: the search is slowed down to it
  double time_limit_s = 20.0;  // 0.1 to 600
  // The joint's limits, rad or m.
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  // Free travel away from the hard stop that must be seen; 0: HardStopSearch::kRangeShare of the
  // way from the stop to the other limit.
  double min_travel = 0.0;
};

Checked check(const Reference& reference);

// The reference of one joint, tick by tick.
class Homing {
 public:
  static constexpr hal::TimeNs kStill_ns = 500'000'000;

  Homing() = default;
  Homing(const Reference& reference, const Transmission& transmission);

  // Forgets the reference: the encoder counts from somewhere else now.
  void lose();

  // One tick. `home`: the controller wants the reference. `sample` is the encoder's and has no
  // fault; a stale one shows no standing still.
  void advance(const AxisSample& sample, bool home, hal::TimeNs now_ns);

  [[nodiscard]] bool is_referenced() const { return state_ == State::referenced; }
  [[nodiscard]] bool is_searching() const { return state_ == State::searching; }
  // The effort that the search wants of the motor now, N m or N at the joint.
  [[nodiscard]] double effort() const { return effort_; }
  // With the reference in its offset.
  [[nodiscard]] const Transmission& transmission() const { return transmission_; }
  [[nodiscard]] Trouble trouble() const;

 private:
  enum class State : std::uint8_t { waiting, searching, referenced, failed };

  void begin(const AxisSample& sample, hal::TimeNs now_ns);
  void search(const AxisSample& sample, hal::TimeNs now_ns);
  void hold_still(const AxisSample& sample, hal::TimeNs now_ns);
  void search_index(const AxisSample& sample, hal::TimeNs now_ns);
  void search_stop(const AxisSample& sample, hal::TimeNs now_ns);
  void found(double encoder_rad);
  void fail(HomingFailure failure);
  [[nodiscard]] double position(const AxisSample& sample) const;
  [[nodiscard]] double velocity(const AxisSample& sample) const;
  [[nodiscard]] bool is_new_index(const AxisSample& sample) const;

  Reference reference_;
  Transmission transmission_;
  State state_ = State::waiting;
  HomingFailure failure_ = HomingFailure::none;
  double effort_ = 0.0;
  hal::TimeNs since_ns_ = 0;
  // known_pose: around here it has stood since then.
  double still_at_ = 0.0;
  hal::TimeNs still_since_ns_ = 0;
  // index: the pulse that had been seen before the search began.
  bool had_index_ = false;
  double old_index_rad_ = 0.0;
  SearchMove move_;
  HardStopSearch stop_;
};

}  // namespace tactus::drivers
