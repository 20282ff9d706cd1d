#include "firmware/linux/telemetry/telemetry_outputs.h"

#include <algorithm>
#include <cerrno>

namespace tactus::firmware {
namespace {

// Ticks older than this are in the file, even if the program is killed.
constexpr hal::TimeNs kFlush_ns = 1'000'000'000;

}  // namespace

void TelemetryOutputs::describe(const RunDescription& run) {
  run_info_ = run.info;
  recorder_.describe(run);
}

int TelemetryOutputs::open_udp(std::uint16_t port, double rate_hz) {
  udp_every_ = std::max(1U, static_cast<std::uint32_t>(rate_hz / kUdpRate_Hz));
  return udp_.open(port);
}

int TelemetryOutputs::carry_out(const TelemetryOrder& order) {
  switch (order.kind) {
    case TelemetryOrder::Kind::record:
      error_.store(0, std::memory_order_relaxed);
      return recorder_.open(order.path, order.if_there);
    case TelemetryOrder::Kind::end:
      return recorder_.is_open() ? recorder_.close() : recording_error();
    case TelemetryOrder::Kind::attach:
      return recorder_.attach(order.attachment) ? 0 : ENOSPC;
  }
  return 0;
}

void TelemetryOutputs::accept_readers(hal::TimeNs now_ns) {
  if (live_.is_open()) {
    live_.accept_readers(encoder_.encode(run_info_), now_ns);
    const LiveWishes wishes = live_.hear_readers();
    is_explaining_.store(wishes.explanations, std::memory_order_relaxed);
    is_placing_.store(wishes.places, std::memory_order_relaxed);
  }
}

void TelemetryOutputs::add(const TelemetryEvent& event) {
  const auto message = encoder_.encode(event);
  recorder_.add(event, message);
  live_.publish(message);
}

void TelemetryOutputs::add(const RecordedTick& tick) {
  const auto message = encoder_.encode(tick);
  recorder_.add(tick, message);
  live_.publish(message);
  if (udp_.is_open() && tick.record.tick % udp_every_ == 0) {
    udp_.send(tick);
  }
}

void TelemetryOutputs::add(const Explanation& explanation) {
  const auto message = encoder_.encode(explanation);
  recorder_.add(explanation, message);
  live_.publish_explanation(message);
}

void TelemetryOutputs::add(const ObjectPlaces& places) {
  live_.publish_places(encoder_.encode(places));
}

void TelemetryOutputs::flush(hal::TimeNs now_ns) {
  live_.send(now_ns);
  if (now_ns - flushed_ns_ >= kFlush_ns) {
    flushed_ns_ = now_ns;
    recorder_.flush();
  }
  if (recorder_.is_open() && recorder_.error() != 0) {
    error_.store(recorder_.close(), std::memory_order_relaxed);
  }
}

void TelemetryOutputs::close() {
  error_.store(carry_out({.kind = TelemetryOrder::Kind::end}), std::memory_order_relaxed);
  live_.close();
}

}  // namespace tactus::firmware
