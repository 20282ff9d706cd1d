// A moteus servo on a CAN FD bus, as its register protocol shows it. Tests and `tactus emulate
// moteus` run it.
//
// It fakes writes and reads of any integer or float type in one frame, replies in the frame kind of
// the query, the modes of position control with their start, faults and what ends them, the
// command's time-out, and refused registers. It does not fake calibration, other control modes
// (their torque is zero), the integral and the limits of position control, encoders, the console,
// current, voltage and temperature (constant).
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

#include "hal/can_bus.h"
#include "hal/clock.h"
#include "host_tools/emulators/can_emulator.h"

namespace tactus::host {

// The servo's settings and what it is attached to. Turns (rev) are those of the output.
struct MoteusEmulatorConfig {
  // Its number in the CAN identifier, 1 to 127.
  std::uint8_t servo_id = 1;
  // The upper bits of the CAN identifier that it answers to.
  std::uint16_t prefix = 0;
  // The time for which it obeys a silent host whose command gave no time-out.
  double default_timeout_s = 0.1;
  // Its mode after the command's time-out: 12 damps the motion, 0 lets go.
  int timeout_mode = 12;
  // The largest torque of that damping.
  double timeout_max_torque_Nm = 5.0;
  // The largest torque of position control.
  double max_torque_Nm = 1.0;
  // The gains of its own position control.
  double kp_Nm_per_rev = 4.0;
  double kd_Nm_s_per_rev = 0.05;
  // The time from the first command to position control, through the modes 2, 3 and 4.
  double start_s = 0.02;
  // Turns of the rotor in one turn of the output.
  double gear = 1.0;
  // True if it has an encoder at the output; else it knows its rotor within a turn after power-up.
  bool output_encoder = false;
  // False for a servo that ignores the command's time-out.
  bool has_watchdog = true;
};

// One servo.
class MoteusEmulator final : public CanEmulator {
 public:
  MoteusEmulator(hal::CanBus& bus, std::uint32_t seed, const MoteusEmulatorConfig& config);

  // Returns the mode that register 0x000 shows.
  [[nodiscard]] int mode() const { return mode_; }

  // Faults inside of the servo. This one sets a fault code, 32 to 50, and stops the motor.
  void raise_fault(int code);
  // Sets what holds the torque back, 96 to 103; 0: nothing.
  void limit(int code);
  // Makes positions read NaN from now on.
  void lose_position(bool is_lost);

 private:
  // The registers that the host writes; a write of the mode resets the others to these values.
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
  // A frame of the host, as far as it has been read.
  struct Query {
    // The command that the frame's writes make of the one in effect.
    Command written;
    // True once the frame has written the mode; else its writes have no effect.
    bool has_mode = false;
    // The payload of the answer.
    std::vector<std::uint8_t> answer;
  };
  // The encoder, as far as the position that register 0x001 shows depends on it.
  struct PositionSensor {
    // The output's angle at which the position is zero.
    double zero_rad = 0.0;
    // True while the position reads NaN.
    bool is_lost = false;
  };
  using Bytes = std::span<const std::byte>;

  void take(hal::TimeNs now_ns, const hal::CanFrame& frame) override;
  void advance(const DriveRun& run) override;

  // Handles the reads and writes of a frame, one subframe after the other.
  void read_subframes(Bytes payload);
  // do_write() and do_read() handle one subframe: `count` registers in the given type. They take it
  // off `rest` and return false if the frame ends before the subframe does.
  bool do_write(unsigned type, unsigned count, Bytes& rest);
  bool do_read(unsigned type, unsigned count, Bytes& rest);
  // Writes a register of the command; returns false if there is no such register or mode.
  bool write_register(unsigned at, double value);
  // Reads a register into `value`, in its unit; returns false if there is no such register.
  bool read_register(unsigned at, double& value) const;
  void obey(hal::TimeNs now_ns);
  // Starts as after a power cycle: stopped, without fault and command, whole turns lost.
  void boot();
  // Goes through the states of the start, and into the time-out if the host is silent.
  void proceed(hal::TimeNs now_ns);
  // Sets the shaft's torque from mode and command.
  void set_torque();
  // Sends the answer to the query that came in `asking`, padded to a length that CAN FD has.
  void reply(hal::TimeNs now_ns, const hal::CanFrame& asking);

  static constexpr double kRevPerRad = 0.5 / std::numbers::pi;

  MoteusEmulatorConfig config_;
  Query query_;
  // The command in effect, and when the host last commanded.
  Command command_;
  hal::TimeNs commanded_ns_ = 0;
  // The mode of register 0x000, and when its last start began.
  int mode_ = 0;
  hal::TimeNs started_ns_ = 0;
  // Register 0x00F: the fault, else the limit.
  int fault_ = 0;
  int limit_ = 0;
  // The position to hold when the command's position is NaN.
  double held_rev_ = 0.0;
  PositionSensor sensor_;
};

}  // namespace tactus::host
