// Frames as text, as `candump -L` writes them, and logs of them kept in golden/.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hal/can_frame.h"

namespace tactus::drivers {

// "(0.012345) can0 02E#0000803E"; the time counts from `start_ns`, in s.
std::string candump_line(const hal::CanReceived& received, hal::TimeNs start_ns);

// The part behind the interface of such a line: "02E#0000803E", "021#R", "00008001##1..." for
// CAN FD with its flags (1: bit-rate switch). Spaces are skipped. A mistake fails the test.
hal::CanFrame frame_of(std::string_view text);

// Returns the text of a frame; the inverse of frame_of.
std::string text_of(const hal::CanFrame& frame);

std::vector<std::byte> bytes_of(std::string_view hex);

// Compares the lines with golden/<name>.log. With TACTUS_RENEW_GOLDEN=1 in the environment it
// writes that file instead; check the change by `git diff`.
::testing::AssertionResult is_golden(const std::string& name, std::span<const std::string> lines);

}  // namespace tactus::drivers
