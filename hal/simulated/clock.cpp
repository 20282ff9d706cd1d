#include "hal/simulated/clock.h"

#include <algorithm>

namespace tactus::hal {

void SimulatedClock::advance_to(TimeNs time_ns) {
  while (step(time_ns)) {
  }
}

bool SimulatedClock::step(TimeNs limit_ns) {
  // An event that waits would let time pass inside another event, so it does not wait.
  if (in_event_) {
    return false;
  }
  SimulatedEventSource* source = earliest();
  const TimeNs event_ns = source == nullptr ? kForever : source->next_event_ns();
  if (event_ns != kForever && event_ns <= std::max(limit_ns, now_ns_)) {
    now_ns_ = std::max(now_ns_, event_ns);
    in_event_ = true;
    source->run_event();
    in_event_ = false;
    return true;
  }
  if (limit_ns != kForever) {
    now_ns_ = std::max(now_ns_, limit_ns);
  }
  return false;
}

SimulatedEventSource* SimulatedClock::earliest() const {
  SimulatedEventSource* found = nullptr;
  for (SimulatedEventSource* source = first_; source != nullptr; source = source->next_) {
    if (found == nullptr || source->next_event_ns() < found->next_event_ns()) {
      found = source;
    }
  }
  return found;
}

void SimulatedClock::attach(SimulatedEventSource& source) {
  SimulatedEventSource** link = &first_;
  while (*link != nullptr) {
    link = &(*link)->next_;
  }
  source.next_ = nullptr;
  *link = &source;
}

void SimulatedClock::detach(SimulatedEventSource& source) {
  for (SimulatedEventSource** link = &first_; *link != nullptr; link = &(*link)->next_) {
    if (*link == &source) {
      *link = source.next_;
      return;
    }
  }
}

}  // namespace tactus::hal
