// Tells a contact that buzzes: the force of the surfaces falls to a quarter and rises again, twelve
// times a second or faster, and does not die away. No hand taps that fast, and a tool that bounces
// to rest strikes ever more weakly.
#pragma once

#include <cstdint>

#include "rendering/state/state_archive.h"

namespace tactus::firmware {

class BuzzDetector {
 public:
  // Peaks weaker than that, N, are none.
  void configure(double weakest_peak_N) {
    weakest_peak_N_ = weakest_peak_N;
    restart();
  }
  void restart();

  // The force of this tick, N, `step_s` after the last. True while the contact buzzes.
  bool observe(double force_N, double step_s);

  // Writes its memory to the archive, or reads it back.
  void transfer(rendering::StateArchive& archive);

 private:
  void count_peak();

  double weakest_peak_N_ = 0.0;
  double first_peak_N_ = 0.0;
  double extreme_N_ = 0.0;  // the highest since the last trough, or the lowest since the last peak
  double since_peak_s_ = 0.0;
  std::uint32_t peaks_ = 0;
  bool is_rising_ = false;
};

}  // namespace tactus::firmware
