// A moteus servo on a CAN FD bus, as its register protocol shows it from outside.
//
// Fakes: writes and reads of any integer or float type in one frame, replies in the frame kind of
// the query, the modes of position control with its start, faults and what ends them, the command's
// time-out, refused registers.
// Does not fake: calibration, the other control modes (their torque is zero), the integral and the
// limits of position control, encoders, console, current, voltage and temperature (constant).
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "hal/can_bus.h"
#include "hal/clock.h"
#include "host_tools/emulators/can_emulator.h"

namespace tactus::host {

struct MoteusEmulatorConfig {
  std::uint8_t servo_id = 1;
  std::uint16_t prefix = 0;
  double default_timeout_s = 0.1;
  int timeout_mode = 12;  // 12: hold the speed at zero; 0: free
  double timeout_max_torque_Nm = 5.0;
  double max_torque_Nm = 1.0;
  double kp_Nm_per_rev = 4.0;  // of the servo's own position control
  double kd_Nm_s_per_rev = 0.05;
  double start_s = 0.02;        // through modes 2, 3 and 4
  double gear = 1.0;            // turns of the rotor in one of the output
  bool output_encoder = false;  // else it knows its rotor within a turn after power-up
  bool has_watchdog = true;
};

class MoteusEmulator final : public CanEmulator {
 public:
  MoteusEmulator(hal::CanBus& bus, std::uint32_t seed, const MoteusEmulatorConfig& config);

  [[nodiscard]] int mode() const { return mode_; }

  // Faults inside a servo, which the fault port does not offer.
  void raise_fault(int code);        // 32 to 50
  void limit(int code);              // 96 to 103, or 0: what holds the torque back
  void lose_position(bool is_lost);  // positions are NaN from now on

 private:
  // The registers that the host writes; a write of the mode resets them to these values.
  struct Command {
    int mode = 0;
    double position_rev = 0.0;
    double velocity_rev_per_s = 0.0;
    double feedforward_Nm = 0.0;
    double kp_scale = 1.0;
    double kd_scale = 1.0;
    double max_torque_Nm = std::numeric_limits<double>::quiet_NaN();
    double timeout_s = 0.0;
  };
  using Bytes = std::span<const std::byte>;

  void take(hal::TimeNs now_ns, const hal::CanFrame& frame) override;
  void advance(hal::TimeNs now_ns, bool erroring) override;

  void read_subframes(Bytes payload);
  bool do_write(unsigned type, unsigned count, Bytes& rest);
  bool do_read(unsigned type, unsigned count, Bytes& rest);
  bool write_register(unsigned at, double value);
  bool read_register(unsigned at, double& value) const;
  void obey(hal::TimeNs now_ns);
  void boot();
  void proceed(hal::TimeNs now_ns);
  void set_torque();
  void reply(hal::TimeNs now_ns, const hal::CanFrame& query);

  MoteusEmulatorConfig config_;
  Command written_;        // of the frame being read
  bool has_mode_ = false;  // that frame writes the mode
  std::vector<std::uint8_t> answer_;
  Command command_;
  int mode_ = 0;
  int fault_ = 0;
  int limit_ = 0;
  double held_rev_ = 0.0;  // the position to stay at
  hal::TimeNs mode_since_ns_ = 0;
  hal::TimeNs commanded_ns_ = 0;
  hal::TimeNs ran_ns_ = 0;
  bool has_run_ = false;
  double zero_rad_ = 0.0;  // of the output, where the reported position is zero
  bool position_lost_ = false;
  bool was_erroring_ = false;
};

}  // namespace tactus::host
