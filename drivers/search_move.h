// One move of a homing search: the motor pushes a joint one way, gently, and the joint's answer is
// watched. No input or output; all in the joint's units, rad or m, N m or N.
//
// The push never rises faster than to the whole in kRise_ns, at the start, when it turns about and
// when the joint meets something. It is damped to the search speed. The damping trusts
// the encoder's sign only after the joint has followed a push: with a wrong sign it would drive the
// joint on. Until then the push shrinks with the size of the speed and never turns about.
#pragma once

#include <cstdint>

#include "drivers/axis.h"
#include "hal/clock.h"

namespace tactus::drivers {

enum class HomingFailure : std::uint8_t {
  none,
  not_a_number,     // position or velocity
  too_fast,         // a jump, or a motion beyond kFastest times the search speed
  wrong_way,        // it moves against the push
  did_not_move,     // neither way
  took_too_long,    // a move beyond the time limit
  stop_moved,       // the second approach did not stop where the first did
  short_travel,     // less free travel than the range asks for
  beyond_range,     // more travel than the range has
  range_unknown,    // a hard stop without limits and without min_travel
  no_index,         // no pulse in time, or the joint stood before one
  index_elsewhere,  // the index would put the joint outside its limits
  not_still,        // the joint did not stand still in its known pose
};

// In words, with a remedy; nothing for `none`.
Trouble describe(HomingFailure failure);

class SearchMove {
 public:
  static constexpr hal::TimeNs kRise_ns = 300'000'000;
  // A joint that is pushed in full and stays in place for so long stands: longer than stiction or a
  // gear's play holds it.
  static constexpr hal::TimeNs kStanding_ns = 200'000'000;
  static constexpr double kFastest = 3.0;  // times the search speed

  struct Limits {
    double effort = 0.0;      // above 0
    double speed = 0.0;       // above 0
    double wrong_way = 0.0;   // travel against the push that is a wrong sign
    double still_band = 0.0;  // within this band a joint stands
    hal::TimeNs time_ns = 0;  // for the move
  };

  SearchMove() = default;
  explicit SearchMove(const Limits& limits) : limits_(limits) {}

  // `way` is 1 or -1; 0 brings the joint to rest.
  void begin(double way, double position, hal::TimeNs now_ns);
  // One tick.
  void advance(double position, double velocity, hal::TimeNs now_ns);
  // A tick without a fresh sample: standing still is not shown by it.
  void skip(hal::TimeNs now_ns) { still_since_ns_ = now_ns; }

  [[nodiscard]] double effort() const { return effort_; }
  // Along the way, since the move began.
  [[nodiscard]] double travel() const { return travel_; }
  [[nodiscard]] bool stands() const { return stands_; }
  [[nodiscard]] HomingFailure failure() const { return failure_; }

 private:
  void watch(double position, double velocity, hal::TimeNs now_ns);
  [[nodiscard]] bool moves_too_fast(double position, hal::TimeNs now_ns) const;
  void push(double velocity, hal::TimeNs now_ns);

  Limits limits_;
  double way_ = 0.0;
  double from_ = 0.0;
  double travel_ = 0.0;
  double effort_ = 0.0;
  double still_at_ = 0.0;
  double checked_at_ = 0.0;
  double last_at_ = 0.0;
  hal::TimeNs began_ns_ = 0;
  hal::TimeNs still_since_ns_ = 0;
  hal::TimeNs checked_ns_ = 0;
  hal::TimeNs last_ns_ = 0;
  bool follows_ = false;  // the joint has followed a push: the encoder's sign is right
  bool stands_ = false;
  HomingFailure failure_ = HomingFailure::none;
};

}  // namespace tactus::drivers
