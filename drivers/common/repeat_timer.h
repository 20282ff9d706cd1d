// Spaces the frames that a driver repeats: questions, commands of a bring-up, heartbeats.
#pragma once

#include <optional>

#include "drivers/common/seconds.h"
#include "hal/clock.h"

namespace tactus::drivers {

class RepeatTimer {
 public:
  // Makes the next frame the first one, which is due at once.
  void restart() { sent_ns_.reset(); }
  // Notes that a frame was sent at that time.
  void sent(hal::TimeNs now_ns) { sent_ns_ = now_ns; }
  // Notes the outcome of an attempt to send. After a frame that could not be sent the timer is as
  // after `restart`.
  void tried(bool was_sent, hal::TimeNs now_ns) {
    sent_ns_ = was_sent ? std::optional(now_ns) : std::nullopt;
  }

  [[nodiscard]] bool has_sent() const { return sent_ns_.has_value(); }
  // Returns true for the first frame, and when the period has passed since the last one.
  [[nodiscard]] bool is_due(double period_s, hal::TimeNs now_ns) const {
    return !sent_ns_ || has_passed(period_s, *sent_ns_, now_ns);
  }

 private:
  std::optional<hal::TimeNs> sent_ns_;
};

}  // namespace tactus::drivers
