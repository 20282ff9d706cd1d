// Detects a contact that buzzes: the force of the surfaces falls to a quarter and rises again,
// twelve times a second or faster, and does not die away. No hand taps that fast, and the blows of
// a tool that bounces to rest become weaker.
#pragma once

#include <cstdint>

#include "rendering/state_archive.h"

namespace tactus::firmware {

class BuzzDetector {
 public:
  // Starts anew and ignores peaks below `weakest_peak_N`.
  void configure(double weakest_peak_N) {
    weakest_peak_N_ = weakest_peak_N;
    restart();
  }
  void restart();

  // Takes the force of this tick, N, `step_s` after the last one. Returns true while the contact
  // buzzes.
  bool observe(double force_N, double step_s);

  // Writes its memory to the archive, or reads it back.
  void transfer(rendering::StateArchive& archive);

 private:
  void count_peak();

  double weakest_peak_N_ = 0.0;
  double first_peak_N_ = 0.0;
  double extreme_N_ = 0.0;  // the maximum since the last trough, or the minimum since the last peak
  double since_peak_s_ = 0.0;
  std::uint32_t peaks_ = 0;
  bool is_rising_ = false;
};

}  // namespace tactus::firmware
