// Properties of every board of several axes, whatever arrives over its cable and whenever.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "drivers/axis.h"
#include "tests/fuzz/fuzz_input.h"

namespace tactus::fuzz {

struct BoardLimits {
  double fastest_rad_per_s = 0.0;
  double slack_rad = 0.0;  // of a jump, besides
};

class BoardProperties {
 public:
  explicit BoardProperties(const BoardLimits& limits) : limits_(limits) {}

  // Forgets the last sample: after a bring-up the position may be another.
  void forget() { has_last_ = false; }

  void check(std::span<const drivers::AxisSample> samples, const drivers::Trouble& trouble) {
    constexpr std::uint32_t kFaults =
        drivers::kDeviceLost | drivers::kDeviceEncoderFault | drivers::kDeviceDriveFault;
    const std::uint32_t status = samples[0].status;
    require(((status & kFaults) != 0) == static_cast<bool>(trouble), "a fault says what is wrong");
    require(!trouble || !trouble.remedy.empty(), "a fault says what to do");
    if (status != drivers::kDeviceOk) {
      return;
    }
    for (std::size_t axis = 0; axis < samples.size(); ++axis) {
      check_axis(samples[axis], last_[axis]);
      last_[axis] = samples[axis];
    }
    has_last_ = true;
  }

 private:
  void check_axis(const drivers::AxisSample& sample, const drivers::AxisSample& last) const {
    require(std::isfinite(sample.position_rad), "a valid position is a number");
    require(std::abs(sample.velocity_rad_per_s) <= limits_.fastest_rad_per_s,
            "a valid velocity is within a hand's");
    if (!has_last_) {
      return;
    }
    const double passed_s = 1e-9 * static_cast<double>(sample.time_ns - last.time_ns);
    require(passed_s >= 0.0, "time does not go back");
    require(std::abs(sample.position_rad - last.position_rad) <=
                limits_.fastest_rad_per_s * passed_s + limits_.slack_rad,
            "a valid position does not jump");
  }

  BoardLimits limits_;
  std::array<drivers::AxisSample, drivers::kMaxJoints> last_{};
  bool has_last_ = false;
};

}  // namespace tactus::fuzz
