#include "host_tools/certify/z_width.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "host_tools/certify/workers.h"
#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

// Returns the device's places with that hand, without its tremor.
std::vector<WallContact> contacts_of(const CertifiedDevice& device, const HandParameters& hand) {
  std::vector<WallContact> contacts;
  for (const ContactPlace& place : device.places) {
    WallContact& contact = contacts.emplace_back(place.contact);
    contact.hand = hand;
    contact.hand.tremor_m = 0.0;
  }
  return contacts;
}

// A wall on the certified line, and the points between which it lies.
struct Check {
  WallStiffness wall;
  std::size_t point = 0;
  std::size_t other_point = 0;
};

// Returns the walls that a certificate promises. A third of a stiffness is tried too, since
// stability is not always lost from the stiff side.
std::vector<Check> checks_of(const firmware::StiffnessCertificate& certificate) {
  constexpr double kSofter = 1.0 / 3.0;
  const auto points = certificate.all();
  std::vector<Check> checks;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double stiffness = points[i].stiffness_N_per_m;
    const double damping = points[i].damping_Ns_per_m;
    checks.push_back({{stiffness, damping}, i, i});
    checks.push_back({{kSofter * stiffness, damping}, i, i});
    if (i + 1 < points.size()) {
      const double between = 0.5 * (damping + points[i + 1].damping_Ns_per_m);
      checks.push_back({{certified_stiffness(certificate, between), between}, i, i + 1});
    }
  }
  return checks;
}

// Lowers points until the curve rises to one peak and falls from there: no point is higher than
// those between it and the peak. Chatter of a coarse encoder makes the measured limit ragged.
void smooth_down(std::span<firmware::CertifiedPoint> points) {
  const auto lower = [](firmware::CertifiedPoint& point, const firmware::CertifiedPoint& nearer) {
    point.stiffness_N_per_m = std::min(point.stiffness_N_per_m, nearer.stiffness_N_per_m);
  };
  const auto peak = static_cast<std::size_t>(
      std::ranges::max_element(points, {}, &firmware::CertifiedPoint::stiffness_N_per_m) -
      points.begin());
  for (std::size_t i = peak + 1; i < points.size(); ++i) {
    lower(points[i], points[i - 1]);
  }
  for (std::size_t i = peak; i-- > 0;) {
    lower(points[i], points[i + 1]);
  }
}

// Returns the value rounded down to two digits, so that the dampings are plain numbers.
double rounded_down(double value) {
  if (!(value > 0.0)) {
    return 0.0;
  }
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 1.0);
  return std::floor(value / unit) * unit;
}

// One measurement, step by step.
class Sweep {
 public:
  Sweep(const CertifiedDevice& device, const ZWidthOptions& options,
        const CertifyProgress& progress)
      : options_(options), progress_(progress) {
    for (const NamedHand& hand : options.hands) {
      contacts_.push_back(contacts_of(device, hand.hand));
    }
  }

  ZWidth run() {
    choose_dampings();
    search();
    propose();
    confirm();
    if (!result_.certificate.exists()) {
      throw InputError(
          "the device holds no wall of any stiffness: it needs a higher rate, less delay or more "
          "damping of its own");
    }
    return std::move(result_);
  }

 private:
  // Runs the work on all processors and reports the progress.
  template <class Work>
  void for_all_of(std::string_view what, std::size_t count, const Work& work) {
    std::atomic<std::size_t> done{0};
    for_all(
        count, options_.threads, [] { return ContactTrial(); },
        [&](ContactTrial& trial, std::size_t i) {
          work(trial, i);
          const std::size_t now = ++done;
          if (progress_) {
            progress_(what, now, count);
          }
        });
  }

  // Chooses even steps up to the damping that every hand bears on the softest wall.
  void choose_dampings() {
    std::vector<double> most(contacts_.size());
    for_all_of("looking for the largest damping", contacts_.size(),
               [&](ContactTrial& trial, std::size_t hand) {
                 most[hand] = largest_stable_damping(trial, contacts_[hand]);
               });
    const double largest = *std::ranges::min_element(most);
    const std::size_t count = largest > 0.0 ? options_.dampings : 1;
    const double step = rounded_down(largest / static_cast<double>(options_.dampings - 1));
    for (std::size_t i = 0; i < count; ++i) {
      result_.dampings_Ns_per_m.push_back(step * static_cast<double>(i));
    }
  }

  // Finds the largest stable stiffness of each hand and damping.
  void search() {
    const std::size_t dampings = result_.dampings_Ns_per_m.size();
    for (const NamedHand& hand : options_.hands) {
      result_.curves.push_back({hand.name, std::vector<StableStiffness>(dampings)});
    }
    for_all_of("looking for the largest stiffness", contacts_.size() * dampings,
               [&](ContactTrial& trial, std::size_t i) {
                 const std::size_t hand = i / dampings;
                 const std::size_t damping = i % dampings;
                 result_.curves[hand].limits[damping] =
                     stiffest_stable(trial, contacts_[hand], result_.dampings_Ns_per_m[damping],
                                     options_.precision);
               });
  }

  // Takes the worst hand at each damping, divided by the margin, up to the first damping that bears
  // nothing.
  void propose() {
    firmware::StiffnessCertificate& certificate = result_.certificate;
    certificate.margin = options_.margin;
    for (std::size_t i = 0; i < result_.dampings_Ns_per_m.size(); ++i) {
      double least = kStiffestWall_N_per_m;
      for (const ZWidthCurve& curve : result_.curves) {
        least = std::min(least, curve.limits[i].stiffness_N_per_m);
      }
      const double safe = std::floor(least / options_.margin);
      if (safe <= 0.0) {
        break;
      }
      certificate.points[certificate.count++] = {.damping_Ns_per_m = result_.dampings_Ns_per_m[i],
                                                 .stiffness_N_per_m = safe};
    }
    smooth_down(std::span(certificate.points).first(certificate.count));
  }

  // Lowers the certificate until none of its checks fails.
  void confirm() {
    constexpr double kLower = 0.9;
    firmware::StiffnessCertificate& certificate = result_.certificate;
    std::vector<bool> untried(certificate.count, true);
    while (std::ranges::find(untried, true) != untried.end()) {
      const std::vector<bool> bad = bad_points(untried);
      const auto before = certificate.points;
      for (std::size_t i = 0; i < certificate.count; ++i) {
        double& stiffness = certificate.points[i].stiffness_N_per_m;
        stiffness = bad[i] ? std::floor(kLower * stiffness) : stiffness;
        if (stiffness < 1.0) {
          certificate.count = i;
        }
      }
      smooth_down(std::span(certificate.points).first(certificate.count));
      untried.resize(certificate.count);
      for (std::size_t i = 0; i < certificate.count; ++i) {
        untried[i] = certificate.points[i].stiffness_N_per_m != before[i].stiffness_N_per_m;
      }
    }
  }

  // Returns which points belong to a failed check. Only checks that depend on a point that has
  // changed are run.
  std::vector<bool> bad_points(const std::vector<bool>& untried) {
    std::vector<Check> checks = checks_of(result_.certificate);
    std::erase_if(checks, [&](const Check& check) {
      return !untried[check.point] && !untried[check.other_point];
    });
    std::vector<std::atomic<bool>> failed(checks.size());
    for_all_of("trying out what is to be certified", checks.size() * contacts_.size(),
               [&](ContactTrial& trial, std::size_t i) {
                 const std::size_t check = i % checks.size();
                 const auto& contacts = contacts_[i / checks.size()];
                 failed[check] =
                     failed[check] || !std::ranges::all_of(contacts, [&](const WallContact& c) {
                       return is_stable(trial.run(c, checks[check].wall));
                     });
               });
    std::vector<bool> bad(result_.certificate.count);
    for (std::size_t i = 0; i < checks.size(); ++i) {
      if (failed[i]) {
        bad[checks[i].point] = true;
        bad[checks[i].other_point] = true;
      }
    }
    return bad;
  }

  const ZWidthOptions& options_;
  const CertifyProgress& progress_;
  // The device's places for each hand.
  std::vector<std::vector<WallContact>> contacts_;
  ZWidth result_;
};

}  // namespace

std::vector<NamedHand> certifying_hands() {
  return {{"off", {}}, {"finger", kFingerHand}, {"pen", kPenHand}, {"firm", kFirmHand}};
}

ZWidth measure_z_width(const CertifiedDevice& device, const ZWidthOptions& options,
                       const CertifyProgress& progress) {
  return Sweep(device, options, progress).run();
}

}  // namespace tactus::host
