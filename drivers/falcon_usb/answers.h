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
  // Notes that a packet was sent.
  void ask(hal::TimeNs now_ns) { questions_.ask(now_ns); }

  // Takes a byte. Returns the answer that it ends, if any.
  std::optional<FalconAnswer> take(std::byte byte) {
    if (++bytes_ % kFalconPacketBytes == 0) {
      answered_ns_ = questions_.answer().value_or(answered_ns_);
    }
    const auto reply = reader_.take(byte);
    return reply ? std::optional(FalconAnswer{*reply, answered_ns_}) : std::nullopt;
  }

  // Returns true if a packet has no answer yet.
  [[nodiscard]] bool is_awaited() const { return questions_.is_open(); }
  [[nodiscard]] bool has_asked() const { return questions_.has_asked(); }

 private:
  FalconPacketReader reader_;
  QuestionTimes questions_;
  std::size_t bytes_ = 0;
  // The time of the question that was answered last.
  hal::TimeNs answered_ns_ = 0;
};

}  // namespace tactus::drivers
