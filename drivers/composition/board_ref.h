// A small handle for any kind of board. A device can so be composed of several kinds without a heap
// or a base class.
#pragma once

#include <cstddef>
#include <span>

#include "drivers/axis.h"
#include "hal/clock.h"

namespace tactus::drivers {

// A reference to a board, which must outlive it. A default-constructed BoardRef refers to none, and
// only its operator bool may be called.
class BoardRef {
 public:
  BoardRef() = default;
  template <Board B>
  explicit BoardRef(B& board) : board_(&board), calls_(&kCalls<B>) {}

  explicit operator bool() const { return board_ != nullptr; }
  [[nodiscard]] std::size_t axis_count() const { return calls_->axis_count(board_); }
  void start() const { calls_->start(board_); }
  void read(std::span<AxisSample> samples, hal::TimeNs deadline_ns) const {
    calls_->read(board_, samples, deadline_ns);
  }
  void write(std::span<const AxisCommand> commands) const { calls_->write(board_, commands); }
  void clear_faults() const { calls_->clear_faults(board_); }
  void stop() const { calls_->stop(board_); }
  [[nodiscard]] Trouble trouble(std::size_t axis) const { return calls_->trouble(board_, axis); }

 private:
  struct Calls {
    std::size_t (*axis_count)(const void*);
    void (*start)(void*);
    void (*read)(void*, std::span<AxisSample>, hal::TimeNs);
    void (*write)(void*, std::span<const AxisCommand>);
    void (*clear_faults)(void*);
    void (*stop)(void*);
    Trouble (*trouble)(const void*, std::size_t);
  };

  template <class B>
  static constexpr Calls kCalls = {
      // NOLINTNEXTLINE(readability-static-accessed-through-instance): of one board it is static
      [](const void* board) -> std::size_t { return static_cast<const B*>(board)->axis_count(); },
      [](void* board) { static_cast<B*>(board)->start(); },
      [](void* board, std::span<AxisSample> samples, hal::TimeNs deadline_ns) {
        static_cast<B*>(board)->read(samples, deadline_ns);
      },
      [](void* board, std::span<const AxisCommand> commands) {
        static_cast<B*>(board)->write(commands);
      },
      [](void* board) { static_cast<B*>(board)->clear_faults(); },
      [](void* board) { static_cast<B*>(board)->stop(); },
      [](const void* board, std::size_t axis) {
        return static_cast<const B*>(board)->trouble(axis);
      }};

  void* board_ = nullptr;
  const Calls* calls_ = nullptr;
};

}  // namespace tactus::drivers
