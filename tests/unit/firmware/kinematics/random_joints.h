// Random joints within a configuration's limits, the coupled ones included.
#pragma once

#include <algorithm>
#include <cstdio>
#include <random>

#include "firmware/configuration/controller_config.h"

namespace tactus::firmware {

inline bool within_coupled_limits(const ControllerConfig& config, const Vec3& joints) {
  return std::ranges::all_of(config.coupled_limits, [&](const CoupledLimit& limit) {
    const double difference = joints[static_cast<Eigen::Index>(limit.joint)] -
                              joints[static_cast<Eigen::Index>(limit.minus)];
    return difference >= limit.lower && difference <= limit.upper;
  });
}

class RandomJoints {
 public:
  explicit RandomJoints(std::uint64_t seed) : generator_(seed) {
    std::printf("seed %llu\n", static_cast<unsigned long long>(seed));
  }

  double unit() { return unit_(generator_); }  // -1 to 1
  Vec3 vector() { return {unit(), unit(), unit()}; }

  // Returns a random joint position within the limits; zero for joints that the mechanism does not
  // have.
  Vec3 within(const ControllerConfig& config) {
    Vec3 joints = Vec3::Zero();
    do {
      for (std::size_t i = 0; i < joint_count(config.mechanism); ++i) {
        const JointLimits& limits = config.joints[i];
        joints[static_cast<Eigen::Index>(i)] =
            limits.lower + 0.5 * (1.0 + unit()) * (limits.upper - limits.lower);
      }
    } while (!within_coupled_limits(config, joints));
    return joints;
  }

 private:
  std::mt19937_64 generator_;
  std::uniform_real_distribution<double> unit_{-1.0, 1.0};
};

}  // namespace tactus::firmware
