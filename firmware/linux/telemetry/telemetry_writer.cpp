#include "firmware/linux/telemetry/telemetry_writer.h"

#include <ctime>

#include "hal/linux/system.h"

namespace tactus::firmware {
namespace {

// The thread's cycle: a longer one delays displays, a shorter one costs processor time.
constexpr hal::TimeNs kCycle_ns = 5'000'000;

}  // namespace

int TelemetryWriter::start() {
  const int failed = thread_.start(
      "telemetry", [](void* self) { static_cast<TelemetryWriter*>(self)->run(); }, this);
  started_ = failed == 0;
  return failed;
}

int TelemetryWriter::stop() {
  if (!started_) {
    return end_recording();
  }
  stopping_.store(true, std::memory_order_release);
  thread_.join();
  started_ = false;
  return recording_error();
}

int TelemetryWriter::record(const char* path, IfThere if_there) {
  return obey({.kind = TelemetryOrder::Kind::record, .path = path, .if_there = if_there});
}

int TelemetryWriter::end_recording() {
  return obey({.kind = TelemetryOrder::Kind::end});
}

bool TelemetryWriter::attach(const Attachment& attachment) {
  return obey({.kind = TelemetryOrder::Kind::attach, .attachment = attachment}) == 0;
}

int TelemetryWriter::obey(const TelemetryOrder& order) {
  return started_ ? orders_.give(order) : outputs_.carry_out(order);
}

void TelemetryWriter::run() {
  const timespec pause = hal::to_timespec(kCycle_ns);
  while (!stopping_.load(std::memory_order_acquire)) {
    cycle();
    clock_nanosleep(CLOCK_MONOTONIC, 0, &pause, nullptr);
  }
  cycle();  // what came before the stop
  outputs_.close();
}

void TelemetryWriter::cycle() {
  const hal::TimeNs now_ns = hal::monotonic_now_ns();
  outputs_.accept_readers(now_ns);
  while (const TelemetryEvent* event = events_.front()) {
    outputs_.add(*event);
    events_.pop();
  }
  while (const RecordedTick* tick = ticks_.front()) {
    outputs_.add(*tick);
    ticks_.pop();
  }
  while (const Explanation* explanation = explanations_.front()) {
    outputs_.add(*explanation);
    explanations_.pop();
  }
  while (const ObjectPlaces* places = places_.front()) {
    outputs_.add(*places);
    places_.pop();
  }
  outputs_.flush(now_ns);
  if (const TelemetryOrder* const order = orders_.waiting(); order != nullptr) {
    orders_.answer(outputs_.carry_out(*order));
  }
}

}  // namespace tactus::firmware
