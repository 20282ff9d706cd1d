#include "firmware/linux/telemetry/order_slot.h"

#include <ctime>

#include "hal/linux/system.h"

namespace tactus::firmware {

int OrderSlot::give(const TelemetryOrder& order) {
  // The interval at which the thread looks for the answer.
  const timespec look = hal::to_timespec(500'000);
  order_ = order;
  is_waiting_.store(true, std::memory_order_release);
  while (is_waiting_.load(std::memory_order_acquire)) {
    clock_nanosleep(CLOCK_MONOTONIC, 0, &look, nullptr);
  }
  return answer_;
}

}  // namespace tactus::firmware
