// Units of people's files and messages. Everything inside is in SI units.
#pragma once

namespace tactus::host {

// A millimetre in metres, and how many millimetres a metre has.
inline constexpr double kMillimetre_m = 0.001;
inline constexpr double kMillimetresPerMetre = 1000.0;

}  // namespace tactus::host
