// A board of motor drives on one CAN bus.
//
// A tick has two exchanges. `read` sends the frames that the drives need before a sample. It then
// waits until every healthy drive that reports a position has sent a fresh one, or until the
// deadline. `write` sends the commands. An error of the bus itself counts for every axis: a link
// that is down, an interface that is gone, a controller that is off the bus, or a send queue that
// stays full latches kDeviceLost.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <variant>

#include "drivers/axis.h"
#include "drivers/can_drive.h"
#include "drivers/composition/can_bus_watch.h"
#include "hal/can_bus.h"
#include "hal/clock.h"

namespace tactus::drivers {

// `Kinds` are the types of drives that the board may carry, in any mix.
template <CanDrive... Kinds>
class CanBoard {
 public:
  // The bus and the clock must outlive the board.
  CanBoard(hal::CanBus& bus, const hal::Clock& clock) : bus_(&bus), clock_(&clock) {}

  // Adds a copy of the drive. Call before `start`. Returns false if there are kMaxJoints drives
  // already.
  template <class Kind>
  bool add(const Kind& drive) {
    if (count_ == drives_.size()) {
      return false;
    }
    drives_[count_].template emplace<Kind>(drive);
    ++count_;
    return true;
  }

  [[nodiscard]] std::size_t axis_count() const { return count_; }

  void start() {
    listen();
    forget_what_waits();
    const hal::TimeNs now_ns = clock_->now_ns();
    watch_ = {};
    for_each([now_ns](auto& drive, std::size_t) { drive.start(now_ns); });
  }

  // Fills in the samples; the span has room for axis_count() of them.
  void read(std::span<AxisSample> samples, hal::TimeNs deadline_ns) {
    receive(hal::kNoWait);  // first: `request` must know the frames that wait in the queue
    outbox_.clear();
    const hal::TimeNs now_ns = clock_->now_ns();
    for_each([&](auto& drive, std::size_t i) {
      const std::size_t before = outbox_.frames().size();
      drive.request(now_ns, outbox_);
      if (outbox_.frames().size() > before) {  // an earlier sample is not the answer
        seen_ns_[i] = drive.sample().time_ns;
      }
    });
    send();
    while (waits_for_a_sample() && receive(deadline_ns)) {
    }
    for_each([&](auto& drive, std::size_t i) {
      samples[i] = drive.sample();
      samples[i].status |= watch_.status();
      seen_ns_[i] = drive.sample().time_ns;
    });
  }

  void write(std::span<const AxisCommand> commands) {
    outbox_.clear();
    const hal::TimeNs now_ns = clock_->now_ns();
    for_each([&](auto& drive, std::size_t i) {
      drive.command(now_ns, watch_.trouble() ? AxisCommand{} : commands[i], outbox_);
    });
    send();
  }

  // Also restarts the bus interface if it was off the bus.
  void clear_faults() {
    if (watch_.is_off_the_bus()) {
      (void)bus_->restart();
    }
    watch_ = {};
    const hal::TimeNs now_ns = clock_->now_ns();
    for_each([now_ns](auto& drive, std::size_t) { drive.clear_faults(now_ns); });
  }

  void stop() {
    outbox_.clear();
    for_each([this](auto& drive, std::size_t) { drive.shutdown(outbox_); });
    send();
  }

  [[nodiscard]] Trouble trouble(std::size_t axis) const {
    if (watch_.trouble()) {
      return watch_.trouble();
    }
    Trouble trouble;
    for_each([&](const auto& drive, std::size_t i) {
      if (i == axis) {
        trouble = drive.trouble();
      }
    });
    return trouble;
  }

  // Returns the i-th drive in the order of adding, or null if it is of another kind or not there.
  template <class Kind>
  [[nodiscard]] const Kind* drive(std::size_t i) const {
    return i < count_ ? std::get_if<Kind>(&drives_[i]) : nullptr;
  }

 private:
  using AnyDrive = std::variant<std::monostate, Kinds...>;

  template <class Self, class Action>
  static void visit_each(Self& self, Action&& action) {
    for (std::size_t i = 0; i < self.count_; ++i) {
      const auto visit_one = [&](auto* drive) {
        if (drive != nullptr) {
          action(*drive, i);
        }
      };
      (visit_one(std::get_if<Kinds>(&self.drives_[i])), ...);
    }
  }
  template <class Action>
  void for_each(Action&& action) {
    visit_each(*this, std::forward<Action>(action));
  }
  template <class Action>
  void for_each(Action&& action) const {
    visit_each(*this, std::forward<Action>(action));
  }

  void listen() {
    std::array<hal::CanFilter, kMaxJoints * kMaxFiltersPerDrive> filters;
    std::size_t count = 0;
    for_each([&](const auto& drive, std::size_t) {
      count += drive.filters(std::span(filters).subspan(count, kMaxFiltersPerDrive));
    });
    watch_.note(bus_->set_filters(std::span(filters).first(count)));
    watch_.note(bus_->set_error_classes(hal::kCanBusOff | hal::kCanRestarted));
  }

  void send() {
    if (!outbox_.frames().empty()) {
      watch_.note_sent(bus_->send(outbox_.frames()), outbox_.frames().size());
    }
  }

  // Hands the frames that arrive by the deadline to all drives. Returns false if none arrived.
  bool receive(hal::TimeNs deadline_ns) {
    const auto received = bus_->receive(received_, deadline_ns);
    if (!received) {
      watch_.note_received(received.error());
      return false;
    }
    for (const hal::CanReceived& item : std::span(received_).first(*received)) {
      watch_.take(item);
      for_each([&](auto& drive, std::size_t) { drive.take(item); });
    }
    return true;
  }

  // Drops the frames that came since the bus was opened. They are old, and can be more than a tick
  // has time for.
  void forget_what_waits() {
    while (bus_->receive(received_, hal::kNoWait)) {
    }
  }

  [[nodiscard]] bool waits_for_a_sample() const {
    bool waits = false;
    for_each([&](const auto& drive, std::size_t i) {
      const AxisSample& sample = drive.sample();
      waits = waits ||
              (sample.status == kDeviceOk && sample.time_ns != 0 && sample.time_ns == seen_ns_[i]);
    });
    return waits && !watch_.trouble();
  }

  hal::CanBus* bus_;
  const hal::Clock* clock_;
  std::array<AnyDrive, kMaxJoints> drives_{};
  std::array<hal::TimeNs, kMaxJoints> seen_ns_{};
  std::size_t count_ = 0;
  CanBusWatch watch_;
  CanOutbox outbox_;
  std::array<hal::CanReceived, 64> received_{};
};

}  // namespace tactus::drivers
