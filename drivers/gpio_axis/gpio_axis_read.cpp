// The first half of a tick of GpioAxis: it makes a sample from edges, levels and counts.
#include <cmath>
#include <numbers>

#include "drivers/gpio_axis/gpio_axis.h"

namespace tactus::drivers {

namespace {

// The most reads of a tick: twice as many events as the kernel can keep. The rest waits for the
// next tick.
constexpr std::size_t kEventsPerRead = 64;
constexpr std::size_t kMaxReadsPerTick = 2 * hal::kMaxGpioEdgeBuffer / kEventsPerRead;

}  // namespace

void GpioAxis::read(std::span<AxisSample> samples, hal::TimeNs /*deadline_ns*/) {
  if (running_) {
    const hal::TimeNs now_ns = hardware_.clock->now_ns();
    const bool all = read_edges();
    if (all) {
      read_levels(now_ns);
    }
    read_counter();
    const EncoderReading reading =
        hardware_.counter != nullptr ? encoder_.counts.reading() : encoder_.edges.reading(now_ns);
    watch_silence(reading, now_ns);
    note_safety();
    if (reading.fault != EncoderFault::none) {
      latch(trouble_of(reading.fault));
    }
    sample_.status &= ~std::uint32_t{kDeviceStale};
    if (!all) {
      sample_.status |= kDeviceStale;
    } else if (reading.fault == EncoderFault::none && (sample_.status & kDeviceLost) == 0) {
      take_sample(reading);
    }
    const hal::TimeNs patience_ns = hal::TimeNs{config_.command_timeout_ms} * 1'000'000;
    if (fault_.trouble != GpioAxisTrouble::none ||
        (output_.powered && now_ns - output_.written_ns > patience_ns)) {
      cut_power();
    }
  }
  samples[0] = sample_;
}

// Reads the waiting edges. Returns true if none is left.
bool GpioAxis::read_edges() {
  if (!lines_.watches_edges()) {
    return true;
  }
  std::array<hal::GpioEdgeEvent, kEventsPerRead> events;
  for (std::size_t i = 0; i < kMaxReadsPerTick; ++i) {
    const auto count = lines_.read_edges(events);
    if (!count) {
      if (count.error().code != hal::ErrorCode::timeout) {
        did(std::unexpected(count.error()), GpioAxisTrouble::lines_gone,
            GpioAxisTrouble::lines_fail);
      }
      return true;
    }
    for (const hal::GpioEdgeEvent& event : std::span(events).first(*count)) {
      take(event);
    }
  }
  return false;
}

void GpioAxis::take(const hal::GpioEdgeEvent& event) {
  if (lines_.note(event) != 0) {
    if (hardware_.counter == nullptr) {
      encoder_.edges.fail(EncoderFault::edges_lost);
    } else {
      latch(GpioAxisTrouble::safety_edges_lost);
    }
  }
  const auto line = lines_.line_of(event);
  if (!line) {
    return;
  }
  if (*line == AxisLine::encoder_a) {
    encoder_.edges.take(EncoderChannel::a, event.rising, event.time_ns);
  } else if (*line == AxisLine::encoder_b) {
    encoder_.edges.take(EncoderChannel::b, event.rising, event.time_ns);
  } else if (*line == AxisLine::encoder_index) {
    encoder_.edges.take(EncoderChannel::index, event.rising, event.time_ns);
  } else if (*line == AxisLine::emergency_stop && event.rising) {
    safety_.emergency_stop_edge(event.time_ns);
  } else if (*line == AxisLine::fault && event.rising) {
    safety_.fault_edge();
  }
}

// Reads the levels, after the edges, so that both can be compared. An edge in between only starts
// the time for which they may disagree.
void GpioAxis::read_levels(hal::TimeNs now_ns) {
  if (!lines_.has_inputs()) {
    return;
  }
  const auto levels = lines_.levels();
  if (!levels) {
    did(std::unexpected(levels.error()), GpioAxisTrouble::lines_gone, GpioAxisTrouble::lines_fail);
    return;
  }
  if (hardware_.counter == nullptr) {
    encoder_.edges.compare(levels->is_active(AxisLine::encoder_a),
                           levels->is_active(AxisLine::encoder_b), now_ns);
  }
  safety_.take({.emergency_stop = levels->is_active(AxisLine::emergency_stop),
                .fault = levels->is_active(AxisLine::fault),
                .limit_low = levels->is_active(AxisLine::limit_low),
                .limit_high = levels->is_active(AxisLine::limit_high)},
               now_ns);
}

void GpioAxis::read_counter() {
  if (hardware_.counter == nullptr) {
    return;
  }
  using enum GpioAxisTrouble;
  if (config_.encoder.counter_index) {
    std::array<hal::CounterIndexEvent, 8> pulses;
    const auto count = hardware_.counter->read_index(pulses, hal::kNoWait);
    if (!count && count.error().code != hal::ErrorCode::timeout) {
      did(std::unexpected(count.error()), counter_gone, counter_fails);
      return;
    }
    for (const auto& pulse : std::span(pulses).first(count.value_or(0))) {
      encoder_.counts.take_index(pulse);
    }
  }
  const auto reading = hardware_.counter->read();
  if (!reading) {
    did(std::unexpected(reading.error()), counter_gone, counter_fails);
    return;
  }
  encoder_.counts.take(*reading);
}

void GpioAxis::take_sample(const EncoderReading& reading) {
  const double sign = config_.encoder.reversed ? -1.0 : 1.0;
  const double count_rad = sign * 2.0 * std::numbers::pi / config_.encoder.counts_per_rev;
  sample_.position_rad = count_rad * static_cast<double>(reading.count);
  sample_.velocity_rad_per_s = count_rad * reading.counts_per_s;
  sample_.time_ns = reading.time_ns;
  sample_.index_seen = reading.index_seen;
  sample_.index_rad = count_rad * static_cast<double>(reading.index_count);
}

void GpioAxis::watch_silence(const EncoderReading& reading, hal::TimeNs now_ns) {
  const double least_Nm = config_.encoder.silence_torque * config_.bridge.max_torque_Nm;
  const bool pushes =
      output_.powered && output_.torque_Nm != 0.0 && std::abs(output_.torque_Nm) >= least_Nm;
  const hal::TimeNs silent_ns = encoder_.silence.take(pushes, reading.count, now_ns);
  const hal::TimeNs patience_ns = hal::TimeNs{config_.encoder.silence_ms} * 1'000'000;
  if (patience_ns > 0 && silent_ns > patience_ns) {
    encoder_.edges.fail(EncoderFault::silent);
    encoder_.counts.fail(EncoderFault::silent);
    latch(GpioAxisTrouble::silent);
  }
}

void GpioAxis::note_safety() {
  if (safety_.emergency_stop()) {
    latch(GpioAxisTrouble::emergency_stop);
  }
  if (safety_.fault()) {
    latch(GpioAxisTrouble::bridge_fault);
  }
  if (safety_.limits_contradict()) {
    latch(GpioAxisTrouble::limits_contradict);
  }
}

}  // namespace tactus::drivers
