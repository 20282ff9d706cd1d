// Time counted in turns, so exactly that a vibration never drifts.
#pragma once

#include <cstdint>

namespace tactus::rendering {

// A part of a turn in units of 2^-64, which wraps by itself. A step is rounded once, to 2^-53 of
// itself or 2^-64 of a turn, and adding steps rounds nothing.
using Phase = std::uint64_t;

// `turns` finite; whole turns are dropped.
Phase phase_of_turns(double turns);

// sin(2 pi phase), within 4e-16, the same bits on every machine.
double sine(Phase phase);

}  // namespace tactus::rendering
