// Reports the result of commissioning for people and for the image.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "host_tools/commission/commission.h"

namespace tactus::host {

// One block a joint: what it did, what is wrong, what to check.
std::string report_text(const CommissionReport& report);
std::string report_json(const CommissionReport& report);

// Writes the result, good or bad, for `tactus bake`. `settings_checksum` is
// firmware::all_settings_checksum of the device that was measured. Throws InputError if it cannot
// be written.
void write_commissioning(const std::filesystem::path& file, const CommissionReport& report,
                         const std::string& measured_with, std::uint64_t settings_checksum);

}  // namespace tactus::host
