// Quadrature decoding x4: every edge of either channel is one count.
#pragma once

#include <array>
#include <cstdint>

namespace tactus::drivers {

// The two channels as one number: bit 1 is A, bit 0 is B. Forward, A leads: 00, 10, 11, 01, 00.
constexpr unsigned quadrature_state(bool a, bool b) {
  return (a ? 2U : 0U) | (b ? 1U : 0U);
}

inline constexpr int kIllegalStep = 2;

// The counts from one state to another: 1, -1, 0 for none, kIllegalStep if both channels changed,
// so that the direction is unknown. States are below 4.
constexpr int quadrature_step(unsigned from, unsigned to) {
  constexpr std::array<std::array<std::int8_t, 4>, 4> kSteps = {{{0, -1, 1, kIllegalStep},
                                                                 {1, 0, kIllegalStep, -1},
                                                                 {-1, kIllegalStep, 0, 1},
                                                                 {kIllegalStep, 1, -1, 0}}};
  return kSteps[from][to];
}

// Why a position is worth nothing any more.
enum class EncoderFault : std::uint8_t {
  none,
  edges_lost,          // the sequence numbers show a gap
  illegal_transition,  // a level repeated, or both channels changed at once
  levels_disagree,     // the channels stand otherwise than the edges left them
  index_moved,         // the index pulse came at another place than before
  index_missing,       // more than a turn without an index pulse
  jump,                // the count moved further than the shaft can
  noise,               // the counter reports noise at its inputs
  silent,              // torque, but not one edge
};

}  // namespace tactus::drivers
