// Quadrature decoding x4: every edge of either channel is one count.
#pragma once

#include <array>
#include <cstdint>

namespace tactus::drivers {

// Returns the two channels as one number: bit 1 is A, bit 0 is B. When A leads, the states are 00,
// 10, 11, 01, 00, which is the positive direction.
constexpr unsigned quadrature_state(bool a, bool b) {
  return (a ? 2U : 0U) | (b ? 1U : 0U);
}

inline constexpr int kIllegalStep = 2;

// Returns the counts from one state to another: 1, -1, 0 for no change, or kIllegalStep if both
// channels changed, so that the direction is unknown. States are below 4.
constexpr int quadrature_step(unsigned from, unsigned to) {
  constexpr std::array<std::array<std::int8_t, 4>, 4> kSteps = {{{0, -1, 1, kIllegalStep},
                                                                 {1, 0, kIllegalStep, -1},
                                                                 {-1, kIllegalStep, 0, 1},
                                                                 {kIllegalStep, 1, -1, 0}}};
  return kSteps[from][to];
}

// The reason why a position is invalid.
enum class EncoderFault : std::uint8_t {
  none,
  edges_lost,          // the sequence numbers show a gap
  illegal_transition,  // a level repeated, or both channels changed at once
  levels_disagree,     // the levels differ from those after the last edges
  index_moved,         // the index pulse came at another place than before
  index_missing,       // more than a turn without an index pulse
  jump,                // the count moved further than the shaft can turn
  noise,               // the counter reports noise at its inputs
  silent,              // torque without a single edge
};

}  // namespace tactus::drivers
