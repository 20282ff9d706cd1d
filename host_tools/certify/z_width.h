// Every stiffness and damping that a device can render as a stable wall: its Z-width (Colgate and
// Brown, ICRA 1994), and the part of it that is certified.
//
// For each damping the largest stable stiffness is searched for, hand by hand, at every place of
// the device; the worst place counts. The certificate takes the worst hand and divides by the
// margin. Then it is tried out: every certified point, a third of it, and the middle of the
// straight line to the next point, at every place with every hand; a point that is not stable is
// lowered until it is.
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

struct NamedHand {
  std::string name;
  HandParameters hand;
};
// Off, and the simulation's three.
std::vector<NamedHand> certifying_hands();

struct ZWidthOptions {
  std::vector<NamedHand> hands = certifying_hands();
  std::size_t dampings = 9;  // 2 to kMaxCertifiedPoints
  double precision = 0.02;   // of a stiffness, relative
  double margin = 1.25;
  unsigned threads = 0;  // 0: one a processor
};

// One line of the picture.
struct ZWidthCurve {
  std::string hand;
  std::vector<StableStiffness> limits;  // one a damping
};

struct ZWidth {
  std::vector<double> dampings_Ns_per_m;  // from 0 to the largest that a soft wall bears, rising
  std::vector<ZWidthCurve> curves;
  firmware::StiffnessCertificate certificate;
};

// Called from any thread: what is being done, how much of it is done.
using CertifyProgress =
    std::function<void(std::string_view what, std::size_t done, std::size_t all)>;

// The same device and options give the same result, on however many threads. Throws InputError when
// the device bears no wall at all.
ZWidth measure_z_width(const CertifiedDevice& device, const ZWidthOptions& options,
                       const CertifyProgress& progress = {});

}  // namespace tactus::host
