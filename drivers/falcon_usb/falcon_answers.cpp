// The part of Falcon that takes the device's answers. It checks when they come, and whether they
// are possible.
#include "drivers/falcon_usb/falcon.h"
#include "drivers/falcon_usb/falcon_trouble.h"

namespace tactus::drivers {

namespace {

constexpr std::size_t kFalconPacketsATick = 16;

}  // namespace

void Falcon::drain() {
  for (std::size_t i = 0; i < kFalconPacketsATick && receive(hal::kNoWait); ++i) {
  }
}

void Falcon::exchange(hal::TimeNs deadline_ns) {
  const bool awaited = answers_.is_awaited();
  drain();
  for (std::size_t i = 0;
       i < kFalconPacketsATick && awaited && !reads_.is_fresh() && !reads_.doubt(); ++i) {
    if (!receive(deadline_ns)) {
      break;
    }
  }
  if (awaited || reads_.doubt()) {
    judge();
  }
}

void Falcon::judge() {
  if (!reads_.end_in_fault()) {
    return;
  }
  if (reads_.doubt()) {
    latch(kDeviceEncoderFault, reads_.doubt());
  } else if (answers_.has_bytes()) {
    latch(kDeviceEncoderFault, kFalconGarbled);
  } else {
    latch(kDeviceLost, kFalconSilent);
  }
}

bool Falcon::receive(hal::TimeNs deadline_ns) {
  const auto received = link_.receive(deadline_ns);
  if (!received) {
    lose(received.error());
    return false;
  }
  const auto& bytes = *received;
  if (!bytes) {
    return false;
  }
  take(ftdi_payload(*bytes));
  check(link_.read_on());
  return true;
}

void Falcon::take(std::span<const std::byte> payload) {
  if (state_ != State::running) {
    bring_up_.take(payload, clock_->now_ns());
    return;
  }
  for (const std::byte byte : payload) {
    if (const auto answer = answers_.take(byte)) {
      accept(*answer);
    }
  }
}

void Falcon::accept(const FalconAnswer& answer) {
  if (faults_ || !answers_.has_asked()) {
    return;
  }
  const FalconReply& reply = answer.reply;
  if (arms_.is_homed() && !reply.all_homed()) {
    reads_.doubt(kFalconReferenceLost);
  } else if (arms_.is_homed() && !arms_.can_reach(reply.counts, answer.asked_ns)) {
    reads_.doubt(kFalconJumped);
  } else {
    believe(answer);
  }
}

void Falcon::believe(const FalconAnswer& answer) {
  reads_.believe();
  newest_.buttons = answer.reply.buttons;
  if (arms_.is_homed()) {
    arms_.take(answer.reply.counts, answer.asked_ns);
  } else {
    arms_.take_in_homing(answer.reply.all_homed(), answer.reply.counts, answer.asked_ns);
  }
}

}  // namespace tactus::drivers
