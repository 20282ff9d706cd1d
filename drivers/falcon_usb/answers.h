// Finds the answers of a Falcon in its bytes, and the time of the question to each.
#pragma once

#include <cstddef>
#include <optional>

#include "drivers/common/question_times.h"
#include "drivers/falcon_usb/packet.h"
#include "hal/clock.h"

namespace tactus::drivers {

// An answer, and the time at which its question was sent.
struct FalconAnswer {
  FalconReply reply;
  hal::TimeNs asked_ns = 0;
};

// The device answers in turn, so as many bytes as an answer has answer a question, even if they are
// damaged.
class FalconAnswers {
 public:
  // Forgets the questions and the bytes.
  void restart() {
    reader_.restart();
    questions_ = {};
    bytes_ = 0;
  }
  // Drops the bytes of an answer that is not complete.
  void resynchronize() { reader_.restart(); }
  // Begins a read, in which no byte has come yet.
  void begin_read() { has_bytes_ = false; }
  // Notes that a packet was sent.
  void ask(hal::TimeNs now_ns) { questions_.ask(now_ns); }

  // Takes a byte. Returns the answer that it ends, if any.
  std::optional<FalconAnswer> take(std::byte byte) {
    has_bytes_ = true;
    if (++bytes_ % kFalconPacketBytes == 0) {
      answered_ns_ = questions_.answer().value_or(answered_ns_);
    }
    const auto reply = reader_.take(byte);
    return reply ? std::optional(FalconAnswer{*reply, answered_ns_}) : std::nullopt;
  }

  // Returns true if a packet has no answer yet.
  [[nodiscard]] bool is_awaited() const { return questions_.is_open(); }
  // Returns true if a byte came in this read.
  [[nodiscard]] bool has_bytes() const { return has_bytes_; }
  [[nodiscard]] bool has_asked() const { return questions_.has_asked(); }

 private:
  FalconPacketReader reader_;
  QuestionTimes questions_;
  std::size_t bytes_ = 0;
  bool has_bytes_ = false;
  // The time of the question that was answered last.
  hal::TimeNs answered_ns_ = 0;
};

}  // namespace tactus::drivers
