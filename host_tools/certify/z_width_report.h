// Reports a Z-width as a table for programs, and as lines and a picture for people.
#pragma once

#include <filesystem>
#include <string>

#include "host_tools/certify/z_width.h"

namespace tactus::host {

// Writes one line a damping with the columns damping_Ns_per_m, stiffness_<hand>_N_per_m for each
// hand, and certified_N_per_m, which is empty where nothing is certified. Throws InputError if the
// file cannot be written.
void write_z_width_csv(const ZWidth& z_width, const std::filesystem::path& csv);

// Returns the table for a terminal, with the place that limits the weakest hand in each line.
std::string z_width_table(const ZWidth& z_width, const CertifiedDevice& device);

// Returns the point with the largest certified stiffness; the certificate must have one.
firmware::CertifiedPoint stiffest_certified(const firmware::StiffnessCertificate& certificate);

// Draws stiffness over damping: the limit of every hand, and the certified region below. Throws
// InputError if gnuplot is missing or fails.
void draw_z_width(const ZWidth& z_width, const std::string& device_name,
                  const std::string& measured_with, const std::filesystem::path& picture);

}  // namespace tactus::host
