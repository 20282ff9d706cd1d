// Simulated time, shared by all simulated parts of a test. Tests use one thread; nothing here is
// safe for two.
#pragma once

#include "hal/clock.h"

namespace tactus::hal {

class SimulatedEventSource;

// The link of a source in the clock's list.
class SimulatedEventLink {
  friend class SimulatedClock;
  SimulatedEventSource* next_ = nullptr;
};

// A simulated part that acts at its own time: a frame that ends on the wire, a line that settles,
// an emulated drive.
class SimulatedEventSource : public SimulatedEventLink {
 public:
  SimulatedEventSource(const SimulatedEventSource&) = delete;
  SimulatedEventSource& operator=(const SimulatedEventSource&) = delete;

  // Returns when it acts next; kForever if it has nothing to do. A past time means now.
  virtual TimeNs next_event_ns() const = 0;

  // Runs the event; the clock shows its time. Afterwards next_event_ns must be later, or the clock
  // cannot move on.
  virtual void run_event() = 0;

 protected:
  SimulatedEventSource() = default;
  ~SimulatedEventSource() = default;
};

// The time of a test.
//
// Simulated: a monotonic clock that moves only by advance_* and while a caller waits. Waiting takes
// simulated time and no real time. Events on the way run in the order of their time, then of
// attachment. So a deadline is exact and a run repeats to the nanosecond. Not simulated: latency (a
// sleeper wakes exactly on time), threads (there is one only).
class SimulatedClock final : public Clock {
 public:
  // Starts at one second, so that a time of 0 is in the past (see kNoWait).
  explicit SimulatedClock(TimeNs start_ns = 1'000'000'000) : now_ns_(start_ns) {}

  // Moves to that time and runs the events up to and at it. Never moves back.
  void advance_to(TimeNs time_ns);
  // Moves by that duration.
  void advance_by(TimeNs duration_ns) { advance_to(now_ns_ + duration_ns); }

  // Lets time pass until `ready()` or the deadline. Returns true if ready. A wait without a
  // deadline that no event can end returns at once. Within an event time does not pass, so a wait
  // returns at once there too.
  template <class Ready>
  bool wait_until(TimeNs deadline_ns, Ready ready) {
    while (!ready()) {
      if (!step(deadline_ns)) {
        return ready();
      }
    }
    return true;
  }

  // Adds or removes a source. The source must outlive its attachment, and the clock the source.
  void attach(SimulatedEventSource& source);
  void detach(SimulatedEventSource& source);

 private:
  TimeNs DoNowNs() const override { return now_ns_; }
  void DoSleepUntil(TimeNs wake_ns) override { advance_to(wake_ns); }

  // Moves to the next event and runs it. If there is none up to the limit, moves to the limit and
  // returns false.
  bool step(TimeNs limit_ns);
  // Returns the source whose event comes first; null without sources.
  SimulatedEventSource* earliest() const;

  TimeNs now_ns_;
  SimulatedEventSource* first_ = nullptr;
  // True while a source's run_event is on the stack.
  bool in_event_ = false;
};

}  // namespace tactus::hal
