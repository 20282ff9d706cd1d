// Properties of every drive on a CAN bus, whatever arrives from the bus and whenever.
#pragma once

#include <cmath>
#include <cstdint>

#include "drivers/can_drive.h"
#include "tests/fuzz/fuzz_input.h"

namespace tactus::fuzz {

struct DriveLimits {
  double max_torque_Nm = 0.0;
  double max_speed_rad_per_s = 0.0;
  double jump_margin_rad = 0.0;
};

class DriveProperties {
 public:
  explicit DriveProperties(const DriveLimits& limits) : limits_(limits) {}

  // Forgets the last sample: after a bring-up the position may be another.
  void forget() { has_last_ = false; }

  // A sample that is reported as valid is a number, in reach of the one before, and a fault has
  // words.
  void check_sample(const drivers::AxisSample& sample, const drivers::Trouble& trouble) {
    constexpr std::uint32_t kNoFault = drivers::kDeviceStale | drivers::kDeviceNotReady;
    const bool is_faulty = (sample.status & ~kNoFault) != 0;
    require(is_faulty == static_cast<bool>(trouble), "a fault says what is wrong");
    require(!is_faulty || !trouble.remedy.empty(), "a fault says what to do");
    if ((sample.status & ~std::uint32_t{drivers::kDeviceStale}) != 0) {
      has_last_ = false;
      return;
    }
    require(std::isfinite(sample.position_rad) && std::isfinite(sample.velocity_rad_per_s) &&
                std::isfinite(sample.torque_Nm),
            "a valid sample holds numbers");
    require(std::abs(sample.velocity_rad_per_s) <= limits_.max_speed_rad_per_s,
            "a valid velocity is within the shaft's");
    if (has_last_) {
      const double passed_s = 1e-9 * static_cast<double>(sample.time_ns - last_.time_ns);
      const double reach_rad =
          limits_.max_speed_rad_per_s * std::max(passed_s, 0.0) + limits_.jump_margin_rad;
      require(std::abs(sample.position_rad - last_.position_rad) <= reach_rad + 1e-9,
              "a valid position does not jump");
    }
    last_ = sample;
    has_last_ = true;
  }

  // `torque_of` decodes the torque that a frame commands, zero if none.
  template <class TorqueOf>
  void check_outbox(const drivers::AxisSample& sample, const drivers::CanOutbox& outbox,
                    TorqueOf torque_of) const {
    const bool is_well = (sample.status & ~std::uint32_t{drivers::kDeviceStale}) == 0;
    for (const hal::CanFrame& frame : outbox.frames()) {
      require(hal::is_valid(frame), "a frame is well-formed");
      const double torque_Nm = std::abs(torque_of(frame));
      require(torque_Nm <= limits_.max_torque_Nm, "no torque beyond the limit");
      require(is_well || torque_Nm == 0.0, "no torque from an axis that is not well");
    }
  }

 private:
  DriveLimits limits_;
  drivers::AxisSample last_;
  bool has_last_ = false;
};

// Random frames (`random_frame` makes one), ticks and resets until the input ends.
template <drivers::CanDrive Drive, class TorqueOf, class RandomFrame>
void fuzz_drive(Drive& drive, DriveProperties& properties, hal::TimeNs now_ns, FuzzInput& input,
                TorqueOf torque_of, RandomFrame random_frame) {
  constexpr hal::TimeNs kMs = 1'000'000;
  drivers::CanOutbox outbox;
  while (!input.empty()) {
    const std::uint32_t action = input.below(16);
    if (action < 9) {
      // Stamped anywhere around now, also in the future.
      const hal::TimeNs time_ns = now_ns + 1000 * hal::TimeNs{input.take<std::int16_t>()};
      drive.take({.time_ns = time_ns, .frame = random_frame(input)});
    } else if (action < 15) {
      now_ns += action == 9 ? kMs * input.below(3000) : kMs / 2;
      outbox.clear();
      drive.request(now_ns, outbox);
      properties.check_sample(drive.sample(), drive.trouble());
      properties.check_outbox(drive.sample(), outbox, torque_of);
      outbox.clear();
      drive.command(now_ns, {.torque_Nm = input.take<double>(), .enable = action != 10}, outbox);
      properties.check_outbox(drive.sample(), outbox, torque_of);
    } else if (input.below(8) == 0) {
      outbox.clear();
      drive.shutdown(outbox);
      properties.check_outbox(drive.sample(), outbox, torque_of);
      drive.start(now_ns);
      properties.forget();
    } else {
      drive.clear_faults(now_ns);
      if (drive.sample().status != drivers::kDeviceOk) {
        properties.forget();
      }
    }
    properties.check_sample(drive.sample(), drive.trouble());
  }
}

}  // namespace tactus::fuzz
