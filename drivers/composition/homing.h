// Homing finds the reference of one joint: where the joint is when its encoder reads a given angle.
//
// Before that the encoder counts from its position at power-up. A joint with an `absolute`
// reference needs no homing. The other kinds wait for the controller's `home`:
//   board        the board finds its own reference (the Falcon's homing bits)
//   known_pose   the user holds the joint still in a known pose for kStill_ns while `home` is
//                asked for
//   index        the encoder's index pulse is at a known position. The user moves the joint over
//                it, or the motor does if search_effort is not 0
//   hard_stop    the motor pushes the joint gently against a stop at a known position, and
//                checks that it is the stop (hard_stop_search.h)
// A motor that searches pushes with search_effort at most. Its push rises slowly and is damped to
// search_speed. Each of its moves takes no longer than `time_limit_s`.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>

#include "drivers/axis.h"
#include "drivers/common/field_error.h"
#include "drivers/common/setting.h"
#include "drivers/composition/hard_stop_search.h"
#include "drivers/composition/search_move.h"
#include "drivers/composition/transmission.h"
#include "hal/clock.h"

namespace tactus::drivers {

enum class ReferenceKind : std::uint8_t { absolute, board, known_pose, index, hard_stop };
constexpr auto setting_words(ReferenceKind /*of*/) {
  return std::to_array<Word<ReferenceKind>>({{"absolute", ReferenceKind::absolute},
                                             {"board", ReferenceKind::board},
                                             {"known_pose", ReferenceKind::known_pose},
                                             {"index", ReferenceKind::index},
                                             {"hard_stop", ReferenceKind::hard_stop}});
}

// The kind of a joint's reference and the limits of the search for it.
struct Reference {
  ReferenceKind kind = ReferenceKind::absolute;
  double position = 0.0;       // of the joint at the reference, rad or m
  double search_effort = 0.0;  // N m or N at the joint; its sign is the direction; 0: by hand
  double search_speed = 0.5;   // rad/s or m/s; above 0, to 100; a motor's search is damped to it
  double time_limit_s = 20.0;  // for each move; 0.1 to 600
  // The joint's limits, rad or m.
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  // The free travel away from the hard stop that the search must see, rad or m. 0 stands for
  // HardStopSearch::kRangeShare of the distance from the stop to the other limit.
  double min_travel = 0.0;
};

// Checks every field against its range, and that the fields fit together.
Checked check(const Reference& reference);

// The homing of one joint, tick by tick.
class Homing {
 public:
  static constexpr hal::TimeNs kStill_ns = 500'000'000;

  Homing() = default;
  Homing(const Reference& reference, const Transmission& transmission);

  // Forgets the reference, because the encoder counts from another zero now.
  void lose();

  // Advances by one tick. `home` is true while the controller wants the reference. `sample` is that
  // of the encoder and has no fault; a stale one does not show that the joint stands still.
  void advance(const AxisSample& sample, bool home, hal::TimeNs now_ns);

  [[nodiscard]] bool is_referenced() const { return state_ == State::referenced; }
  [[nodiscard]] bool is_searching() const { return state_ == State::searching; }
  // Returns the effort that the search wants of the motor now, N m or N at the joint.
  [[nodiscard]] double effort() const { return effort_; }
  // Returns the transmission, with the reference in its offset.
  [[nodiscard]] const Transmission& transmission() const { return transmission_; }
  // Returns the reason why homing failed, or an empty Trouble.
  [[nodiscard]] Trouble trouble() const;

 private:
  enum class State : std::uint8_t { waiting, searching, referenced, failed };

  // The joint has stood near this position since that time.
  struct StandingStill {
    double position = 0.0;
    hal::TimeNs since_ns = 0;
  };

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
  // For known_pose.
  StandingStill still_;
  // For index: the pulse that had been seen before the search began.
  std::optional<double> old_index_rad_;
  SearchMove move_;
  HardStopSearch stop_;
};

}  // namespace tactus::drivers
