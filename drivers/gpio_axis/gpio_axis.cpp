// The part of GpioAxis that starts, ends and latches. The two halves of a tick are in
// gpio_axis_read.cpp and gpio_axis_write.cpp.
#include "drivers/gpio_axis/gpio_axis.h"

namespace tactus::drivers {

static_assert(Board<GpioAxis>);

GpioAxis::GpioAxis(const GpioAxisConfig& config, hal::GpioLines& lines, hal::PwmOutput& pwm,
                   const hal::Clock& clock)
    : GpioAxis(config, nullptr, lines, pwm, clock) {}

GpioAxis::GpioAxis(const GpioAxisConfig& config, hal::Counter& counter, hal::GpioLines& lines,
                   hal::PwmOutput& pwm, const hal::Clock& clock)
    : GpioAxis(config, &counter, lines, pwm, clock) {}

GpioAxis::GpioAxis(const GpioAxisConfig& config, hal::Counter* counter, hal::GpioLines& lines,
                   hal::PwmOutput& pwm, const hal::Clock& clock)
    : config_(config),
      hardware_{.counter = counter, .pwm = &pwm, .clock = &clock},
      lines_(config, lines),
      encoder_{.edges = {config.encoder, config.pins.encoder_index.has_value()},
               .counts = CounterEncoder(config.encoder),
               .silence = {}},
      bridge_(config.bridge),
      safety_(hal::TimeNs{config.emergency_stop_release_ms} * 1'000'000) {}

void GpioAxis::start() {
  running_ = false;
  output_ = {};
  fault_ = {};
  sample_ = {};
  if (!check(config_, hardware_.counter != nullptr)) {
    latch(GpioAxisTrouble::not_configured);
    return;
  }
  using enum GpioAxisTrouble;
  if (!did(lines_.request(config_.edge_buffer), lines_gone, lines_fail) || !start_pwm()) {
    return;
  }
  bridge_ = HBridge(config_.bridge);
  safety_.restart();
  if (start_encoder()) {
    running_ = true;
    sample_.status &= ~std::uint32_t{kDeviceNotReady};
    cut_power();
    read_levels(hardware_.clock->now_ns());
    note_safety();
  }
}

bool GpioAxis::start_pwm() {
  using enum GpioAxisTrouble;
  if (hardware_.pwm->settings().period_ns != 0 && !set_duty(0)) {
    return false;
  }
  return did(hardware_.pwm->set_period_ns(config_.bridge.pwm_period_ns), pwm_gone, pwm_fails) &&
         set_duty(bridge_.idle(hardware_.clock->now_ns()).duty_ns) &&
         did(hardware_.pwm->set_enabled(true), pwm_gone, pwm_fails);
}

bool GpioAxis::start_encoder() {
  using enum GpioAxisTrouble;
  encoder_.silence.restart(hardware_.clock->now_ns());
  sample_.index_seen = false;
  if (hardware_.counter != nullptr) {
    const hal::CounterConfig wanted{.ceiling = config_.encoder.counter_ceiling,
                                    .watch_index = config_.encoder.counter_index};
    if (!did(hardware_.counter->start(wanted), counter_gone, counter_fails)) {
      return false;
    }
    const auto reading = hardware_.counter->read();
    if (!reading) {
      return did(std::unexpected(reading.error()), counter_gone, counter_fails);
    }
    encoder_.counts.restart(*reading, hardware_.counter->ceiling());
    return true;
  }
  const auto levels = lines_.levels();
  if (!levels) {
    return did(std::unexpected(levels.error()), lines_gone, lines_fail);
  }
  encoder_.edges.restart(levels->is_active(AxisLine::encoder_a),
                         levels->is_active(AxisLine::encoder_b),
                         levels->is_active(AxisLine::encoder_index), hardware_.clock->now_ns());
  return true;
}

void GpioAxis::clear_faults() {
  if (!running_ || (sample_.status & kDeviceLost) != 0) {
    start();
    return;
  }
  const bool reference_lost = (sample_.status & kDeviceEncoderFault) != 0;
  sample_.status = kDeviceOk;
  fault_ = {};
  safety_.clear(hardware_.clock->now_ns());
  note_safety();
  if (reference_lost) {
    read_edges();
    running_ = start_encoder();
  }
}

void GpioAxis::stop() {
  if (running_) {
    cut_power();
    running_ = false;
    sample_.status |= kDeviceNotReady;
  }
}

Trouble GpioAxis::trouble(std::size_t /*axis*/) const {
  return describe(fault_.trouble);
}

std::int64_t GpioAxis::index_error() const {
  return hardware_.counter != nullptr ? encoder_.counts.index_error()
                                      : encoder_.edges.index_error();
}

bool GpioAxis::did(const hal::Result<void>& outcome, GpioAxisTrouble gone, GpioAxisTrouble fails) {
  if (outcome) {
    return true;
  }
  if (fault_.trouble == GpioAxisTrouble::none) {
    fault_.error = outcome.error();
  }
  latch(outcome.error().code == hal::ErrorCode::disconnected ? gone : fails);
  return false;
}

void GpioAxis::latch(GpioAxisTrouble trouble) {
  sample_.status |= status_of(trouble);
  if (fault_.trouble == GpioAxisTrouble::none) {
    fault_.trouble = trouble;
  }
}

}  // namespace tactus::drivers
