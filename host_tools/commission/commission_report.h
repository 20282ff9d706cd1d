// Reports the result of commissioning: as text, as JSON, and as the file that `tactus bake` reads.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "host_tools/commission/commission.h"

namespace tactus::host {

// Returns a block of lines a joint: what it did, what is wrong, what to check.
std::string report_text(const CommissionReport& report);
// Returns one JSON object on one line, with a newline.
std::string report_json(const CommissionReport& report);

// Writes the result, good or bad, as TOML for `tactus bake`. `measured_with` names the method;
// `settings_checksum` is firmware::all_settings_checksum of the device that was measured, so that
// the result is refused for a device with other settings. Throws InputError if the file cannot be
// written.
void write_commissioning(const std::filesystem::path& file, const CommissionReport& report,
                         const std::string& measured_with, std::uint64_t settings_checksum);

}  // namespace tactus::host
