// The parts of Foxglove's messages: times, vectors and poses as JSON. Pure functions for any
// thread.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "firmware/telemetry/object_places.h"

namespace tactus::host {

// The names of the frames: the world of a scene, and the same turned so that z points up, as
// Foxglove draws a frame.
inline constexpr std::string_view kWorldFrame = "W";
inline constexpr std::string_view kUprightFrame = "map";

// The rotation that leaves everything where it is.
inline constexpr firmware::Quadruple kUnturned = {1.0, 0.0, 0.0, 0.0};

// Returns a time since 1970.
std::string time_json(std::uint64_t time_ns);
// Returns x, y and z, with nine digits; 0 in place of a number that is not finite.
std::string vector_json(const firmware::Triple& v);
// Returns a rotation as a quaternion.
std::string rotation_json(const firmware::Quadruple& rotation);
// Returns a pose.
std::string pose_json(const firmware::Triple& position, const firmware::Quadruple& rotation);
// Returns a text with its quotation marks. Bytes that are no UTF-8 are replaced.
std::string text_json(std::string_view text);

}  // namespace tactus::host
