// The send times of questions whose answers have not come, for a device that answers each question
// in turn.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "hal/clock.h"

namespace tactus::drivers {

class QuestionTimes {
 public:
  // The number of open questions that are remembered.
  static constexpr std::size_t kRemembered = 16;

  // Notes a question. With kRemembered open ones the oldest counts as answered.
  void ask(hal::TimeNs now_ns) {
    if (asked_ - answered_ == kRemembered) {
      ++answered_;
    }
    asked_ns_[asked_ % kRemembered] = now_ns;
    ++asked_;
  }
  // Takes the oldest open question as answered. Returns its time, or nothing if none is open.
  std::optional<hal::TimeNs> answer() {
    if (!is_open()) {
      return std::nullopt;
    }
    const hal::TimeNs asked_ns = asked_ns_[answered_ % kRemembered];
    ++answered_;
    return asked_ns;
  }

  // Returns true if a question has no answer yet.
  [[nodiscard]] bool is_open() const { return asked_ != answered_; }
  [[nodiscard]] bool has_asked() const { return asked_ != 0; }

 private:
  std::array<hal::TimeNs, kRemembered> asked_ns_{};
  // The numbers of questions and of answers.
  std::uint32_t asked_ = 0;
  std::uint32_t answered_ = 0;
};

}  // namespace tactus::drivers
