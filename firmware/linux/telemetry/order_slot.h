// Hands orders from another thread to the telemetry writer's thread, one at a time, and the answers
// back. It waits by looking, because an order is rare and no thread of the loop gives one.
#pragma once

#include <atomic>
#include <cstdint>

#include "firmware/linux/telemetry/attachment_list.h"
#include "firmware/linux/telemetry/file_sink.h"

namespace tactus::firmware {

// An order to the thread that owns the recorder.
struct TelemetryOrder {
  // Begins a recording, ends it, or adds an attachment to recordings.
  enum class Kind : std::uint8_t { record, end, attach };
  Kind kind = Kind::end;
  // The file of `record`. It must stay valid until the answer.
  const char* path = nullptr;
  IfThere if_there = IfThere::replace;
  // The attachment of `attach`.
  Attachment attachment;
};

// The slot. One thread gives, another takes.
class OrderSlot {
 public:
  // Gives an order to the other thread, waits until it is carried out, and returns the answer.
  int give(const TelemetryOrder& order);

  // Returns the order that waits, or null. For the thread that carries orders out.
  [[nodiscard]] const TelemetryOrder* waiting() const {
    return is_waiting_.load(std::memory_order_acquire) ? &order_ : nullptr;
  }
  // Answers the order that waits.
  void answer(int answer) {
    answer_ = answer;
    is_waiting_.store(false, std::memory_order_release);
  }

 private:
  std::atomic<bool> is_waiting_{false};
  // These belong to the thread that holds the order.
  TelemetryOrder order_;
  int answer_ = 0;
};

}  // namespace tactus::firmware
