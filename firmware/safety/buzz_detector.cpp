#include "firmware/safety/buzz_detector.h"

#include <algorithm>

namespace tactus::firmware {
namespace {

// This many peaks in a row are a buzz.
constexpr std::uint32_t kPeaks = 5;
// Peaks that are further apart do not belong to one buzz: 12.5 Hz.
constexpr double kLongestPeriod_s = 0.08;
// The force must fall to, and rise from, this part of a peak: a quarter.
constexpr double kFall = 4.0;
// A peak below this share of the first one shows that the motion dies away; the count begins anew.
constexpr double kDying = 0.8;

}  // namespace

void BuzzDetector::restart() {
  first_peak_N_ = 0.0;
  extreme_N_ = 0.0;
  since_peak_s_ = 0.0;
  peaks_ = 0;
  is_rising_ = false;
}

bool BuzzDetector::observe(double force_N, double step_s) {
  // The bound keeps the number finite while there is no contact.
  since_peak_s_ = std::min(since_peak_s_ + step_s, 2.0 * kLongestPeriod_s);
  if (since_peak_s_ > kLongestPeriod_s) {
    peaks_ = 0;
  }
  if (is_rising_) {
    extreme_N_ = std::max(extreme_N_, force_N);
    if (kFall * force_N <= extreme_N_) {
      count_peak();
      extreme_N_ = force_N;
      is_rising_ = false;
    }
  } else {
    extreme_N_ = std::min(extreme_N_, force_N);
    if (force_N >= std::max(kFall * extreme_N_, weakest_peak_N_)) {
      extreme_N_ = force_N;
      is_rising_ = true;
    }
  }
  return peaks_ >= kPeaks;
}

void BuzzDetector::count_peak() {
  if (peaks_ == 0 || extreme_N_ < kDying * first_peak_N_) {
    peaks_ = 0;
    first_peak_N_ = extreme_N_;
  }
  peaks_ = std::min(peaks_ + 1, kPeaks);
  since_peak_s_ = 0.0;
}

}  // namespace tactus::firmware
