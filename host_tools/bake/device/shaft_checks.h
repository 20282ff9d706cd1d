// Checks that a joint's ratios to one drive go together: motor and encoder of a drive are on one
// shaft, unless the file says otherwise.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "host_tools/bake/device/written_sections.h"

namespace tactus::host {

// Throws InputError for a joint with one drive as motor and encoder, of which only one ratio is
// written: the other would be 1. Returns a warning, with file and line, for two ratios or two
// directions that are written and differ.
std::vector<std::string> check_shafts(std::span<const WrittenSection> written);

}  // namespace tactus::host
