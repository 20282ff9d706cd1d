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
      counter_(counter),
      lines_(&lines),
      pwm_(&pwm),
      clock_(&clock),
      wiring_(config),
      edges_(config.encoder, config.pins.encoder_index.has_value()),
      counts_(config.encoder),
      bridge_(config.bridge),
      safety_(hal::TimeNs{config.emergency_stop_release_ms} * 1'000'000) {}

void GpioAxis::start() {
  running_ = false;
  powered_ = false;
  cut_ = false;
  trouble_ = GpioAxisTrouble::none;
  error_ = {};
  sample_ = {};
  if (!check(config_, counter_ != nullptr)) {
    latch(GpioAxisTrouble::not_configured);
    return;
  }
  lines_->release();
  const hal::GpioRequest request{.lines = wiring_.lines(), .edge_buffer = config_.edge_buffer};
  using enum GpioAxisTrouble;
  if (!did(lines_->request(request), lines_gone, lines_fail) || !start_pwm()) {
    return;
  }
  reverse_ = false;
  heartbeat_ = false;
  bridge_ = HBridge(config_.bridge);
  safety_.restart();
  loss_ = {};
  if (start_encoder()) {
    running_ = true;
    sample_.status &= ~std::uint32_t{kDeviceNotReady};
    cut_power();
    read_levels(clock_->now_ns());
    note_safety();
  }
}

bool GpioAxis::start_pwm() {
  using enum GpioAxisTrouble;
  if (pwm_->settings().period_ns != 0 && !set_duty(0)) {
    return false;
  }
  return did(pwm_->set_period_ns(config_.bridge.pwm_period_ns), pwm_gone, pwm_fails) &&
         set_duty(bridge_.idle(clock_->now_ns()).duty_ns) &&
         did(pwm_->set_enabled(true), pwm_gone, pwm_fails);
}

bool GpioAxis::start_encoder() {
  using enum GpioAxisTrouble;
  silent_count_ = 0;
  silent_since_ns_ = clock_->now_ns();
  sample_.index_seen = false;
  if (counter_ != nullptr) {
    const hal::CounterConfig wanted{.ceiling = config_.encoder.counter_ceiling,
                                    .watch_index = config_.encoder.counter_index};
    if (!did(counter_->start(wanted), counter_gone, counter_fails)) {
      return false;
    }
    const auto reading = counter_->read();
    if (!reading) {
      return did(std::unexpected(reading.error()), counter_gone, counter_fails);
    }
    counts_.restart(*reading, counter_->ceiling());
    return true;
  }
  const auto levels = lines_->get(wiring_.inputs());
  if (!levels) {
    return did(std::unexpected(levels.error()), lines_gone, lines_fail);
  }
  const auto active = [&](AxisLine line) { return (*levels & wiring_.bit(line)) != 0; };
  edges_.restart(active(AxisLine::encoder_a), active(AxisLine::encoder_b),
                 active(AxisLine::encoder_index), clock_->now_ns());
  return true;
}

void GpioAxis::clear_faults() {
  if (!running_ || (sample_.status & kDeviceLost) != 0) {
    start();
    return;
  }
  const bool reference_lost = (sample_.status & kDeviceEncoderFault) != 0;
  sample_.status = kDeviceOk;
  trouble_ = GpioAxisTrouble::none;
  error_ = {};
  safety_.clear(clock_->now_ns());
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
  return describe(trouble_);
}

std::int64_t GpioAxis::index_error() const {
  return counter_ != nullptr ? counts_.index_error() : edges_.index_error();
}

bool GpioAxis::did(const hal::Result<void>& outcome, GpioAxisTrouble gone, GpioAxisTrouble fails) {
  if (outcome) {
    return true;
  }
  if (trouble_ == GpioAxisTrouble::none) {
    error_ = outcome.error();
  }
  latch(outcome.error().code == hal::ErrorCode::disconnected ? gone : fails);
  return false;
}

void GpioAxis::latch(GpioAxisTrouble trouble) {
  sample_.status |= status_of(trouble);
  if (trouble_ == GpioAxisTrouble::none) {
    trouble_ = trouble;
  }
}

}  // namespace tactus::drivers
