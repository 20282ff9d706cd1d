#include "drivers/haply_serial/answers.h"

namespace tactus::drivers {

namespace {

constexpr std::uint32_t kHaplyReadsForAnAnswer = 2;

}  // namespace

std::optional<HaplyAnswer> HaplyAnswers::take(std::size_t received) {
  size_ += received;
  if (size_ < whole_) {
    return std::nullopt;
  }
  drop_piece();
  return HaplyAnswer{.bytes = std::span(bytes_).first(whole_), .asked_ns = commands_.answer()};
}

bool HaplyAnswers::drop_late_piece() {
  late_reads_ = size_ > 0 ? late_reads_ + 1 : 0;
  if (late_reads_ < kHaplyReadsForAnAnswer) {
    return false;
  }
  drop_piece();
  (void)commands_.answer();
  return true;
}

}  // namespace tactus::drivers
