// Detects a contact that buzzes: the force of the surfaces falls to a quarter and rises again,
// twelve times a second or faster, and does not die away. No hand taps that fast, and the blows of
// a tool that bounces to rest become weaker. One thread; real time.
#pragma once

#include <cstdint>

#include "rendering/state_archive.h"

namespace tactus::firmware {

// The detector of one tool.
class BuzzDetector {
 public:
  // Starts anew and ignores peaks below `weakest_peak_N`.
  void configure(double weakest_peak_N) {
    weakest_peak_N_ = weakest_peak_N;
    restart();
  }
  // Forgets all peaks.
  void restart();

  // Takes the force of this tick, N, `step_s` after the last one. Returns true while the contact
  // buzzes.
  bool observe(double force_N, double step_s);

  // Writes its memory to the archive, or reads it back.
  void transfer(rendering::StateArchive& archive);

 private:
  // Takes extreme_N_ as a peak.
  void count_peak();

  // Forces below this do not begin a peak.
  double weakest_peak_N_ = 0.0;
  // The first peak of the series that is being counted, N.
  double first_peak_N_ = 0.0;
  // The largest force since the last trough, or the smallest since the last peak, N.
  double extreme_N_ = 0.0;
  double since_peak_s_ = 0.0;
  // The number of peaks of the series, up to the number that is a buzz.
  std::uint32_t peaks_ = 0;
  bool is_rising_ = false;
};

}  // namespace tactus::firmware
