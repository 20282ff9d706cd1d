// Reports a Z-width as a table for programs, and as lines and a picture for people.
#pragma once

#include <filesystem>
#include <string>

#include "host_tools/certify/z_width.h"

namespace tactus::host {

// One line a damping: damping_Ns_per_m, one column stiffness_<hand>_N_per_m a hand, and
// certified_N_per_m, empty where nothing is certified. Throws InputError if it cannot be written.
void write_z_width_csv(const ZWidth& z_width, const std::filesystem::path& csv);

// The same for a terminal, with the place that limits the hand that bears least.
std::string z_width_table(const ZWidth& z_width, const CertifiedDevice& device);

// The largest stiffness of the certificate, at whichever damping.
firmware::CertifiedPoint stiffest_certified(const firmware::StiffnessCertificate& certificate);

// Stiffness over damping: the limit of every hand, and the certified region below them. Throws
// InputError when gnuplot is missing or fails.
void draw_z_width(const ZWidth& z_width, const std::string& device_name,
                  const std::string& measured_with, const std::filesystem::path& png);

}  // namespace tactus::host
