// Writes an animated picture (APNG): a PNG file with the further frames in chunks of their own,
// which browsers and slides play. Programs that do not know them show the first frame.
#pragma once

#include <span>
#include <string>

namespace tactus::host {

// The shortest and the longest time of a frame, s: the format's field ends there.
inline constexpr double kLeastFrame_s = 1e-3;
inline constexpr double kMostFrame_s = 6.0;

// Returns the animation of the frames, each a whole PNG file of the same size, that is repeated
// without end. A frame is shown for `frame_s`, to 0.1 ms. Of each frame but the first only the
// smallest rectangle that changes is stored. Throws InputError if a frame is not a PNG file or has
// another size.
std::string apng_of(std::span<const std::string> frames, double frame_s);

}  // namespace tactus::host
