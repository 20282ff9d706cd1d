#include "firmware/commands/injection.h"

#include <algorithm>
#include <limits>

namespace tactus::firmware {
namespace {

std::uint32_t status_of(Injection injection) {
  switch (injection) {
    case Injection::encoder:
      return drivers::kDeviceEncoderFault;
    case Injection::drive:
      return drivers::kDeviceDriveFault;
    case Injection::estop_line:
      return drivers::kDeviceEmergencyStop;
    case Injection::lost:
      return drivers::kDeviceLost;
    case Injection::not_ready:
      return drivers::kDeviceNotReady;
    default:
      return drivers::kDeviceOk;
  }
}

void change_value(Injection injection, const drivers::JointSample& last,
                  drivers::JointSample& sample) {
  switch (injection) {
    case Injection::stuck:
      sample.position = last.position;
      break;
    case Injection::jump:
      sample.position[0] += kInjectedJump;
      break;
    case Injection::nan:
      sample.position[0] = std::numeric_limits<double>::quiet_NaN();
      break;
    default:
      sample.status |= status_of(injection);
      break;
  }
}

}  // namespace

void Injector::start(const InjectionOrder& order) {
  const bool is_delay = order.injection == Injection::delay;
  left_[static_cast<std::size_t>(order.injection)] =
      std::min(order.ticks, is_delay ? kMaxInjectedDelay : kMaxInjectedTicks);
}

void Injector::change(drivers::JointSample& sample, double rate_hz) {
  std::uint32_t& drops = left_[static_cast<std::size_t>(Injection::drop)];
  const bool dropped = drops > 0;
  if (dropped) {
    --drops;
    age_s_ += 1.0 / rate_hz;
    const std::uint32_t status = sample.status;
    sample = last_;
    sample.age_us += static_cast<std::uint32_t>(1e6 * age_s_);
    sample.status = status | drivers::kDeviceStale;
  } else {
    age_s_ = 0.0;
  }
  if (!dropped && left_[static_cast<std::size_t>(Injection::stuck)] == 0) {
    last_ = sample;
  }
  for (const InjectionText& text : kInjectionTexts) {
    std::uint32_t& left = left_[static_cast<std::size_t>(text.injection)];
    if (left > 0 && text.injection != Injection::drop && text.injection != Injection::delay) {
      --left;
      change_value(text.injection, last_, sample);
    }
  }
}

std::uint32_t Injector::take_delay() {
  std::uint32_t& delay = left_[static_cast<std::size_t>(Injection::delay)];
  const std::uint32_t periods = delay;
  delay = 0;
  return periods;
}

}  // namespace tactus::firmware
