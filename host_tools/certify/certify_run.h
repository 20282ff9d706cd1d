// Certifies a device file: measures what its simulated device holds, and writes the certificate,
// the table and the picture beside the file. `tactus certify` and the Python module use it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "host_tools/certify/certified_device.h"
#include "host_tools/certify/z_width.h"

namespace tactus::host {

// The choices of the user, with the defaults of `tactus certify`.
struct CertifyChoice {
  double margin = ZWidthOptions{}.margin;
  std::size_t dampings = ZWidthOptions{}.dampings;
  // 0: one a processor.
  unsigned threads = 0;
};

// The three files beside the device's.
struct CertifyFiles {
  std::filesystem::path certificate;
  std::filesystem::path csv;
  std::filesystem::path png;
};

// The findings, and where they were written.
struct Certification {
  ZWidth z_width;
  CertifiedDevice device;
  CertifyFiles files;
};

// Certifies the file and writes the three others. Throws InputError if a choice is out of range,
// the file is no device, the device bears no wall, or a file cannot be written.
Certification certify_file(const std::filesystem::path& file, const CertifyChoice& choice,
                           const CertifyProgress& progress = {});

// Returns the findings as one line of JSON.
std::string certification_json(const Certification& certification);

}  // namespace tactus::host
