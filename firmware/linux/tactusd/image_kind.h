// Tells a scene's image from a device's by its first bytes. Not real time.
#pragma once

namespace tactus::firmware {

// Returns true if the file begins as a scene's image does; false for other files, and for one that
// cannot be read.
bool is_scene_image(const char* path);

}  // namespace tactus::firmware
