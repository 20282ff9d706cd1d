// Checks that several devices of one controller can work beside each other on one machine. Not real
// time.
#pragma once

#include <cstddef>
#include <expected>
#include <span>

#include "firmware/device_file/device_checks.h"

namespace tactus::firmware {

// The reason why devices cannot work beside each other.
struct TogetherRefusal {
  // The number of the refused device, 0 for the first, and the part of it.
  std::size_t device = 0;
  Refusal refusal;
};

// Checks that no two devices use the same port, chip or USB device. They may share a CAN bus if
// their drives have numbers and identifiers of their own, agree on the bus' settings, and all of
// their frames fit on it. Each device must have passed its own checks. `words` holds the message.
std::expected<void, TogetherRefusal> check_together(std::span<const DeviceConfig* const> devices,
                                                    Words& words);

}  // namespace tactus::firmware
