#include "hal/can_frame.h"

#include <algorithm>

namespace tactus::hal {

namespace {

// The lengths above 8 bytes that a CAN FD frame can have (ISO 11898-1, data length codes 9 to 15).
constexpr std::array<std::uint8_t, 7> kLongFdLengths{12, 16, 20, 24, 32, 48, 64};

}  // namespace

bool is_valid(const CanFrame& frame) {
  if (frame.id > (frame.extended ? kMaxExtendedId : kMaxStandardId)) {
    return false;
  }
  if (frame.fd) {
    return !frame.remote && frame.length <= kMaxCanFdBytes &&
           padded_fd_length(frame.length) == frame.length;
  }
  return frame.length <= kMaxCanBytes && !frame.bit_rate_switch && !frame.error_state_indicator;
}

std::uint8_t padded_fd_length(std::size_t bytes) {
  if (bytes <= kMaxCanBytes) {
    return static_cast<std::uint8_t>(bytes);
  }
  const auto* fitting = std::ranges::lower_bound(kLongFdLengths, bytes);
  return fitting == kLongFdLengths.end() ? kLongFdLengths.back() : *fitting;
}

std::uint32_t filter_word(const CanFrame& frame) {
  return frame.id | (frame.extended ? CanFilter::kExtended : 0U) |
         (frame.remote ? CanFilter::kRemote : 0U);
}

bool passes(const CanFilter& filter, const CanFrame& frame) {
  const bool match = (filter_word(frame) & filter.mask) == (filter.word & filter.mask);
  return match != filter.inverted;
}

}  // namespace tactus::hal
