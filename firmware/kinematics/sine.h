// Sine and cosine with the same bits on every machine. The C library's differ between versions and
// processors in the last place, which would break the replay of a recorded tick.
#pragma once

namespace tactus::firmware {

struct SineCosine {
  double sine = 0.0;
  double cosine = 1.0;
};

// Within 2.5e-16 of the true values for |angle_rad| <= 1000; for a larger or a non-finite angle
// both are NaN.
SineCosine sine_cosine(double angle_rad);

}  // namespace tactus::firmware
