// Measures every stiffness and damping that a device can render as a stable wall: its Z-width
// (Colgate and Brown, ICRA 1994), and derives the part that is certified. `tactus certify` runs it
// for minutes.
//
// For each damping and each hand it searches for the largest stable stiffness at every place of the
// device; the worst place counts. The certificate takes the worst hand and divides by the margin.
// Then it is confirmed: every certified point, a third of it, and the middle of the straight line
// to the next point are tried at every place with every hand, and a point that fails is lowered
// until it does not.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/safety/certificate.h"
#include "host_tools/certify/certified_device.h"
#include "host_tools/certify/stability_search.h"

namespace tactus::host {

// A hand and its name in tables.
struct NamedHand {
  std::string name;
  HandParameters hand;
};
// Returns the hands of a certificate: off, and the simulation's three.
std::vector<NamedHand> certifying_hands();

// How thorough the measurement is.
struct ZWidthOptions {
  // The hands with which every wall is tried.
  std::vector<NamedHand> hands = certifying_hands();
  // How many dampings are tried, 2 to kMaxCertifiedPoints.
  std::size_t dampings = 9;
  // The relative precision of a stiffness.
  double precision = 0.02;
  // The stiffness that was found stable is divided by this.
  double margin = 1.25;
  // 0: one a processor.
  unsigned threads = 0;
};

// The limits of one hand.
struct ZWidthCurve {
  // The hand's name.
  std::string hand;
  // One for each damping.
  std::vector<StableStiffness> limits;
};

// The result.
struct ZWidth {
  // Rising from 0 to the largest damping that a soft wall bears.
  std::vector<double> dampings_Ns_per_m;
  // One for each hand.
  std::vector<ZWidthCurve> curves;
  // For each damping the least limit over all hands divided by the margin, lowered until every wall
  // that it promises has held in a trial.
  firmware::StiffnessCertificate certificate;
};

// Is called from any thread with what is being done and how much of it is done.
using CertifyProgress =
    std::function<void(std::string_view what, std::size_t done, std::size_t all)>;

// Measures the largest stable stiffness of a wall, for each hand and each damping. The same device
// and options give the same result on any number of threads. Throws InputError if the device bears
// no wall at all.
ZWidth measure_z_width(const CertifiedDevice& device, const ZWidthOptions& options,
                       const CertifyProgress& progress = {});

}  // namespace tactus::host
