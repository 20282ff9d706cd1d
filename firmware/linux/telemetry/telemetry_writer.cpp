#include "firmware/linux/telemetry/telemetry_writer.h"

#include <cerrno>
#include <ctime>

#include "hal/linux/system.h"

namespace tactus::firmware {
namespace {

// The thread's cycle: a longer one delays displays, a shorter one costs processor time.
constexpr hal::TimeNs kCycle_ns = 5'000'000;
// Ticks older than this are in the file, even if the program is killed.
constexpr hal::TimeNs kFlush_ns = 1'000'000'000;
// The interval at which a thread that has given an order looks for the answer.
constexpr hal::TimeNs kOrderWait_ns = 500'000;

void sleep_for(hal::TimeNs time_ns) {
  const timespec time = hal::to_timespec(time_ns);
  clock_nanosleep(CLOCK_MONOTONIC, 0, &time, nullptr);
}

}  // namespace

void TelemetryWriter::describe(const RunDescription& run) {
  run_info_ = run.info;
  recorder_.describe(run);
}

int TelemetryWriter::open_udp(std::uint16_t port, std::uint32_t every) {
  udp_every_ = every == 0 ? 1 : every;
  return udp_.open(port);
}

int TelemetryWriter::start() {
  const int failed = thread_.start(
      "telemetry", [](void* self) { static_cast<TelemetryWriter*>(self)->run(); }, this);
  started_ = failed == 0;
  return failed;
}

int TelemetryWriter::stop() {
  if (!started_) {
    return carry_out(Order::end);
  }
  stopping_.store(true, std::memory_order_release);
  thread_.join();
  started_ = false;
  return recording_error();
}

int TelemetryWriter::record(const char* path, IfThere if_there) {
  path_ = path;
  if_there_ = if_there;
  return obey(Order::record);
}

int TelemetryWriter::end_recording() {
  return obey(Order::end);
}

bool TelemetryWriter::attach(const Attachment& attachment) {
  attachment_ = attachment;
  return obey(Order::attach) == 0;
}

int TelemetryWriter::obey(Order order) {
  if (!started_) {
    return carry_out(order);
  }
  order_.store(order, std::memory_order_release);
  while (order_.load(std::memory_order_acquire) != Order::none) {
    sleep_for(kOrderWait_ns);
  }
  return answer_;
}

int TelemetryWriter::carry_out(Order order) {
  switch (order) {
    case Order::record:
      error_.store(0, std::memory_order_relaxed);
      return recorder_.open(path_, if_there_);
    case Order::end:
      return recorder_.is_open() ? recorder_.close() : recording_error();
    case Order::attach:
      return recorder_.attach(attachment_) ? 0 : ENOSPC;
    case Order::none:
      break;
  }
  return 0;
}

void TelemetryWriter::run() {
  while (!stopping_.load(std::memory_order_acquire)) {
    cycle();
    sleep_for(kCycle_ns);
  }
  cycle();  // what came before the stop
  error_.store(carry_out(Order::end), std::memory_order_relaxed);
  live_.close();
}

void TelemetryWriter::cycle() {
  const hal::TimeNs now_ns = hal::monotonic_now_ns();
  if (live_.is_open()) {
    live_.accept_readers(encoder_.encode(run_info_), now_ns);
  }
  hand_on_events();
  hand_on_ticks();
  live_.send(now_ns);
  flush_at_times(now_ns);
  if (const Order order = order_.load(std::memory_order_acquire); order != Order::none) {
    answer_ = carry_out(order);
    order_.store(Order::none, std::memory_order_release);
  }
}

void TelemetryWriter::hand_on_events() {
  while (const TelemetryEvent* event = events_.front()) {
    const auto message = encoder_.encode(*event);
    recorder_.add(*event, message);
    live_.publish(message);
    events_.pop();
  }
}

void TelemetryWriter::hand_on_ticks() {
  while (const RecordedTick* tick = ticks_.front()) {
    const auto message = encoder_.encode(*tick);
    recorder_.add(*tick, message);
    live_.publish(message);
    if (udp_.is_open() && tick->record.tick % udp_every_ == 0) {
      udp_.send(*tick);
    }
    ticks_.pop();
  }
}

void TelemetryWriter::flush_at_times(hal::TimeNs now_ns) {
  if (now_ns - flushed_ns_ >= kFlush_ns) {
    flushed_ns_ = now_ns;
    recorder_.flush();
  }
  if (recorder_.is_open() && recorder_.error() != 0) {
    error_.store(recorder_.close(), std::memory_order_relaxed);
  }
}

}  // namespace tactus::firmware
