#include "firmware/linux/tactusd/supervisor.h"

#include <algorithm>
#include <cstdio>
#include <string_view>

#include "hal/linux/clock.h"

namespace tactus::firmware {

namespace {

// The interval at which the thread looks for changes; shorter if the watchdog's period asks for it.
constexpr hal::TimeNs kLook_ns = 50'000'000;

static_assert(std::atomic<std::uint64_t>::is_always_lock_free);

}  // namespace

int Supervisor::start(const ServiceNotice& notice, std::size_t devices) {
  notice_ = &notice;
  devices_ = devices;
  watchdog_period_ns_ = ServiceNotice::watchdog_period();
  return thread_.start(
      "tactus-tells", [](void* self) { static_cast<Supervisor*>(self)->run(); }, this);
}

void Supervisor::note(std::span<const Mode> modes) {
  for (std::size_t i = 0; i < modes.size(); ++i) {
    modes_[i].note(modes[i]);
  }
  ticks_.store(ticks_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
}

void Supervisor::stop() {
  stopping_.store(true, std::memory_order_relaxed);
  thread_.join();
}

void Supervisor::run() {
  hal::LinuxClock clock;
  const hal::TimeNs look_ns = std::min(kLook_ns, watchdog_period_ns_.value_or(hal::kForever) / 4);
  while (!stopping_.load(std::memory_order_relaxed)) {
    print_modes();
    notify_manager(clock.now_ns());
    clock.sleep_until(clock.now_ns() + look_ns);
  }
  print_modes();
  notice_->send("STOPPING=1\n");
}

void Supervisor::print_modes() {
  for (std::size_t i = 0; i < devices_; ++i) {
    std::array<char, 32> device{};
    if (devices_ > 1) {
      std::snprintf(device.data(), device.size(), "device %zu: ", i + 1);
    }
    while (const auto mode = modes_[i].next()) {
      const std::string_view name = mode_name(*mode);
      std::fprintf(stderr, "tactusd: %s%.*s\n", device.data(), static_cast<int>(name.size()),
                   name.data());
    }
  }
}

void Supervisor::notify_manager(hal::TimeNs now_ns) {
  const std::uint64_t ticks = ticks_.load(std::memory_order_relaxed);
  if (ticks == ticks_seen_) {
    return;
  }
  if (ticks_seen_ == 0) {
    notice_->send("READY=1\n");
    next_watchdog_ns_ = now_ns;
  }
  ticks_seen_ = ticks;
  if (watchdog_period_ns_ && now_ns >= next_watchdog_ns_) {
    notice_->send("WATCHDOG=1\n");
    next_watchdog_ns_ = now_ns + *watchdog_period_ns_ / 2;
  }
}

}  // namespace tactus::firmware
