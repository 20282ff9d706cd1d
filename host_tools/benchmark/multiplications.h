// Counts the multiplications and divisions of the god-object's position, as Zilles and Salisbury
// (IROS 1995) do. `tactus bench multiplications` prints them.
#pragma once

#include <array>
#include <cstddef>

namespace tactus::host {

// The multiplications and divisions with one, two and three active planes.
using Multiplications = std::array<std::size_t, 3>;

// The numbers of the lecture, which are those of the paper.
inline constexpr Multiplications kMultiplicationsOfTheLecture{12, 33, 65};

// Solves for three planes at an angle, all of which push, with numbers that count
// (rendering/geometry/plane_solutions.h).
Multiplications count_multiplications();

}  // namespace tactus::host
