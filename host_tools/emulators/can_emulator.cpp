#include "host_tools/emulators/can_emulator.h"

#include <array>
#include <span>

namespace tactus::host {

void CanEmulator::run(hal::TimeNs now_ns) {
  std::array<hal::CanReceived, 8> received;  // few arrive between two runs
  const bool hears = fault_.has_power(now_ns);
  bool may_be_more = true;
  while (may_be_more) {
    const std::size_t count = bus_.receive(received, hal::kNoWait).value_or(0);
    for (std::size_t i = 0; hears && i < count; ++i) {
      if (received[i].kind == hal::CanReceived::Kind::frame) {
        take(now_ns, received[i].frame);
      }
    }
    may_be_more = count == received.size();
  }
  if (!hears) {
    waiting_.clear();
    shaft_.torque_Nm = 0.0;
    return;
  }
  advance(begin_run(now_ns));
  send_what_is_due(now_ns);
}

DriveRun CanEmulator::begin_run(hal::TimeNs now_ns) {
  DriveRun run{.now_ns = now_ns, .erroring = fault_.is(EmulatorFault::erroring)};
  if (last_run_) {
    run.gap_ns = now_ns - last_run_->now_ns;
  }
  run.error_begins = run.erroring && !(last_run_ && last_run_->erroring);
  last_run_ = run;
  return run;
}

void CanEmulator::send(hal::TimeNs now_ns, const hal::CanFrame& frame) {
  if (fault_.is(EmulatorFault::silent)) {
    return;
  }
  Waiting& late = waiting_.emplace_back(Waiting{now_ns + fault_.delay_ns(), frame});
  if (fault_.is(EmulatorFault::corrupted) && !frame.remote && frame.length > 0) {
    flip_a_bit(std::span(late.frame.data).first(frame.length), random_);
  }
}

// A full transmit queue is no error: the frame stays in front and is sent in a later run.
void CanEmulator::send_what_is_due(hal::TimeNs now_ns) {
  while (!waiting_.empty() && waiting_.front().due_ns <= now_ns) {
    if (!bus_.send(waiting_.front().frame)) {
      return;
    }
    waiting_.pop_front();
  }
}

}  // namespace tactus::host
