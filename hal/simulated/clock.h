// Simulated time, shared by everything simulated.
#pragma once

#include "hal/clock.h"

namespace tactus::hal {

class SimulatedEventSource;

// The place of a source in the clock's list.
class SimulatedEventLink {
  friend class SimulatedClock;
  SimulatedEventSource* next_ = nullptr;
};

// Something that acts at a time of its own: a frame that ends on the wire, a line that settles, an
// emulated drive.
class SimulatedEventSource : public SimulatedEventLink {
 public:
  SimulatedEventSource(const SimulatedEventSource&) = delete;
  SimulatedEventSource& operator=(const SimulatedEventSource&) = delete;

  // When it acts next; kForever if it has nothing to do. A time that has passed means now.
  virtual TimeNs next_event_ns() const = 0;

  // The clock stands at the event's time. Afterwards next_event_ns must be later, or the clock
  // cannot move on.
  virtual void run_event() = 0;

 protected:
  SimulatedEventSource() = default;
  ~SimulatedEventSource() = default;
};

// Fakes: a monotonic clock that moves only when told, by advance_* or by somebody waiting. Waiting
// takes simulated time and no real time; what is due on the way happens, in the order of time, then
// of attachment. So a deadline is exact and a run repeats to the nanosecond.
// Does not fake: latency (whoever sleeps wakes on the nanosecond), threads (one only).
class SimulatedClock final : public Clock {
 public:
  explicit SimulatedClock(TimeNs start_ns = 1'000'000'000) : now_ns_(start_ns) {}

  // Events up to and at that time happen. Does not go back.
  void advance_to(TimeNs time_ns);
  void advance_by(TimeNs duration_ns) { advance_to(now_ns_ + duration_ns); }

  // Lets time pass until `ready()` or the deadline, and says which. A wait without end that no
  // event can end is over at once. Inside an event time stands still: whatever waits there gets
  // what is there.
  template <class Ready>
  bool wait_until(TimeNs deadline_ns, Ready ready) {
    while (!ready()) {
      if (!step(deadline_ns)) {
        return ready();
      }
    }
    return true;
  }

  // The source must outlive its attachment, and the clock the source.
  void attach(SimulatedEventSource& source);
  void detach(SimulatedEventSource& source);

 private:
  TimeNs DoNowNs() const override { return now_ns_; }
  void DoSleepUntil(TimeNs wake_ns) override { advance_to(wake_ns); }

  // Moves on to the next event and runs it; if there is none up to the limit, moves to the limit
  // and returns false.
  bool step(TimeNs limit_ns);
  SimulatedEventSource* earliest() const;

  TimeNs now_ns_;
  SimulatedEventSource* first_ = nullptr;
  bool in_event_ = false;
};

}  // namespace tactus::hal
