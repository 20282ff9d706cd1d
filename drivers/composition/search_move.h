// One move of a homing search: the motor pushes a joint gently in one direction, and the move
// watches how the joint answers. It has no input or output. All values are in the joint's units:
// rad or m, N m or N.
//
// The push rises to the full effort in kRise_ns and never faster: at the start, when it reverses,
// and when the joint meets something. It is damped to the search speed. The damping trusts the sign
// of the encoder only after the joint has followed a push, because with a wrong sign it would drive
// the joint on. Until then the push shrinks with the size of the speed and never reverses.
#pragma once

#include <cstdint>

#include "drivers/axis.h"
#include "hal/clock.h"

namespace tactus::drivers {

// The reason why a search failed.
enum class HomingFailure : std::uint8_t {
  none,
  not_a_number,     // the position or the velocity
  too_fast,         // a jump, or a motion beyond kFastest times the search speed
  wrong_way,        // the joint moves against the push
  did_not_move,     // in neither direction
  took_too_long,    // a move beyond the time limit
  stop_moved,       // the second approach did not stop where the first did
  short_travel,     // less free travel than the range asks for
  beyond_range,     // more travel than the range has
  range_unknown,    // a hard stop without limits and without min_travel
  no_index,         // no pulse in time, or the joint stood before one
  index_elsewhere,  // the index would put the joint outside its limits
  not_still,        // the joint did not stand still in its known pose
};

// Returns the failure in words with a remedy, or an empty Trouble for `none`.
Trouble describe(HomingFailure failure);

class SearchMove {
 public:
  static constexpr hal::TimeNs kRise_ns = 300'000'000;
  // A joint that gets the full push and stays in place for so long stands. The time is longer than
  // stiction or the play of a gear holds it.
  static constexpr hal::TimeNs kStanding_ns = 200'000'000;
  static constexpr double kFastest = 3.0;  // times the search speed

  // The limits of the move, in the joint's units.
  struct Limits {
    double effort = 0.0;      // above 0
    double speed = 0.0;       // above 0
    double wrong_way = 0.0;   // travel against the push that shows a wrong sign
    double still_band = 0.0;  // a joint that stays within this band stands
    hal::TimeNs time_ns = 0;  // for the move
  };

  SearchMove() = default;
  explicit SearchMove(const Limits& limits) : limits_(limits) {}

  // Starts the move. `way` is the direction, 1 or -1; 0 brings the joint to rest.
  void begin(double way, double position, hal::TimeNs now_ns);
  // Advances by one tick.
  void advance(double position, double velocity, hal::TimeNs now_ns);
  // Replaces `advance` in a tick without a fresh sample, which does not show that the joint stands.
  void skip(hal::TimeNs now_ns) { standstill_.delay(now_ns); }

  // Returns the effort for the motor now.
  [[nodiscard]] double effort() const { return effort_; }
  // Returns the travel in the direction of the push since the move began.
  [[nodiscard]] double travel() const { return travel_; }
  // Returns true if the joint gets the full push and has stood for kStanding_ns.
  [[nodiscard]] bool stands() const { return standstill_.is_reached(); }
  [[nodiscard]] HomingFailure failure() const { return failure_; }

 private:
  // The joint's position at a time.
  struct Place {
    double position = 0.0;
    hal::TimeNs time_ns = 0;
  };

  // Detects that the joint stands: it stays in one place while it gets the full push.
  class Standstill {
   public:
    // Starts with a joint that does not stand.
    void restart(const Place& place) {
      since_ = place;
      is_reached_ = false;
    }
    // Takes the joint's place in a tick. A joint within `band` of its last place stays there.
    void take(const Place& place, bool has_full_push, double band);
    // Makes the joint's time in its place start again.
    void delay(hal::TimeNs now_ns) { since_.time_ns = now_ns; }

    // Returns true if the joint has stood for kStanding_ns.
    [[nodiscard]] bool is_reached() const { return is_reached_; }

   private:
    // The joint has stayed near this place since then.
    Place since_;
    bool is_reached_ = false;
  };

  void watch(const Place& place, double velocity);
  [[nodiscard]] bool moves_too_fast(const Place& place) const;
  void push(double velocity, hal::TimeNs now_ns);

  Limits limits_;
  // 1 or -1; 0: the joint comes to rest.
  double way_ = 0.0;
  double travel_ = 0.0;
  double effort_ = 0.0;
  Place begun_;
  // The begin of the window over which speeds are judged.
  Place checked_;
  // The last tick.
  Place last_;
  // The joint has followed a push: the encoder's sign is right.
  bool follows_ = false;
  Standstill standstill_;
  HomingFailure failure_ = HomingFailure::none;
};

}  // namespace tactus::drivers
