// An ODrive axis on a CAN bus, firmware 0.5.x or 0.6.x, as its CANSimple protocol shows it. Tests
// and `tactus emulate odrive` run it.
//
// It fakes heartbeat and encoder messages by the drive's clock, requests by remote or empty frames,
// the axis states, torque mode with its speed limit, the watchdog, errors and their clearing, and
// booting after kPowerLoss_ns without a run: the position starts anew, and settings that were not
// saved are lost. It does not fake calibration, other control modes (their torque is zero), SDO,
// addresses, firmware update, and temperature (constant).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <string_view>

#include "hal/can_bus.h"
#include "hal/clock.h"
#include "host_tools/emulators/can_emulator.h"
#include "host_tools/emulators/emulated_encoder.h"

namespace tactus::host {

// The firmware versions whose messages differ.
enum class ODriveFirmware : std::uint8_t { v0_5_2, v0_5_4, v0_5_6, v0_6 };

// Returns the version of a text: "0.5.2", "0.5.4", "0.5.6" or "0.6". Throws InputError for another.
ODriveFirmware odrive_firmware(std::string_view version);

// The axis' settings and what it is attached to. Turns are those of the motor's shaft.
struct ODriveEmulatorConfig {
  // Its CAN identifier's upper six bits.
  std::uint8_t node_id = 0;
  // The rule for its position after power-up.
  EmulatedEncoder encoder = EmulatedEncoder::incremental;
  ODriveFirmware firmware = ODriveFirmware::v0_6;
  // The periods of its messages; 0: never sent.
  std::uint32_t heartbeat_ms = 100;
  std::uint32_t encoder_ms = 1;
  // The time for which it obeys a host that has fallen silent; 0, the drive's default, means for
  // ever.
  double watchdog_s = 0.02;
  // The motor's current limit times its torque constant.
  double max_torque_Nm = 1.0;
  // Turns torques into the currents that it reports.
  double torque_constant_Nm_per_A = 0.055;
  // True: torque mode brakes beyond the speed limit. The next flag makes overspeed an error.
  bool enable_torque_mode_speed_limit = true;
  double speed_limit_turn_per_s = 50.0;
  // The gain with which torque mode holds the speed limit.
  double speed_gain_Nm_s_per_turn = 1.0 / 6.0;
  bool enable_overspeed_error = true;
  // False for an axis that was never calibrated: it refuses closed loop.
  bool calibrated = true;
};

// One axis. The functions after axis_state() play events that no bus message causes.
class ODriveEmulator final : public CanEmulator {
 public:
  ODriveEmulator(hal::CanBus& bus, std::uint32_t seed, const ODriveEmulatorConfig& config);

  // Returns the axis state by the firmware's number: 1 idle, 8 closed loop.
  [[nodiscard]] std::uint32_t axis_state() const { return state_; }
  // Returns the limit in force, which the host may have changed.
  [[nodiscard]] double speed_limit_turn_per_s() const { return host_.speed_limit_turn_per_s; }

  // Raises an axis error, by the firmware's numbers, and disarms.
  void raise(std::uint32_t axis_error);
  // Raises an error of the motor, for firmware 0.5, which the axis error shows as well, and
  // disarms.
  void raise_motor_error(std::uint64_t error);
  // Leaves closed loop without an error.
  void drop_to_idle();
  // Sends an encoder message of a wrong length.
  void send_wrong_length(hal::TimeNs now_ns);
  // Sends an encoder message whose position is NaN.
  void send_not_a_number(hal::TimeNs now_ns);

 private:
  using Payload = std::array<std::uint8_t, 8>;

  // The settings that the host makes by messages and that a power cycle loses.
  struct HostSettings {
    // The numbers of CANSimple: control mode (3 position, 1 torque), input mode (1 passed through).
    std::uint32_t control_mode = 3;
    std::uint32_t input_mode = 1;
    double torque_Nm = 0.0;
    double speed_limit_turn_per_s = 0.0;
  };

  // The errors that the axis reports until they are cleared, by the firmware's numbers; 0: none.
  struct Errors {
    std::uint32_t axis = 0;
    // The axis errors that ended closed loop, and the result of the last request for a state. Both
    // are reported by firmware 0.6.
    std::uint32_t disarm_reason = 0;
    std::uint8_t procedure_result = 0;
    // The errors of the axis' parts, reported by firmware 0.5.
    std::uint64_t motor = 0;
    std::uint32_t encoder = 0;
    std::uint32_t controller = 0;
  };

  // When the periodic messages are due.
  struct NextMessages {
    hal::TimeNs heartbeat_ns = 0;
    hal::TimeNs estimates_ns = 0;
  };

  void take(hal::TimeNs now_ns, const hal::CanFrame& frame) override;
  void advance(const DriveRun& run) override;

  // Answers a request for the data of `command`; stays silent if the firmware has no such message.
  void answer(hal::TimeNs now_ns, unsigned command);
  // Carries out a command with its eight data bytes; unknown commands have no effect.
  void obey(hal::TimeNs now_ns, unsigned command, const Payload& payload);
  // Goes to closed loop (8) if there is no error and the axis is calibrated; any other state is
  // idle.
  void request_state(hal::TimeNs now_ns, std::uint32_t state);
  // Sends the periodic messages that are due.
  void send_due_messages(hal::TimeNs now_ns);
  // Sends error, state and, as the firmware has them, flags; the layout differs between firmwares.
  void send_heartbeat(hal::TimeNs now_ns);
  // Sends position in turns and speed in turns/s.
  void send_estimates(hal::TimeNs now_ns);
  // Sends the first `length` bytes of `payload` as the message `command` of this axis.
  void send_payload(hal::TimeNs now_ns, unsigned command, const Payload& payload,
                    std::uint8_t length = 8);
  // Raises the errors of an expired watchdog and of overspeed.
  void watch(hal::TimeNs now_ns);
  // Sets the shaft's torque from the command.
  void set_torque();
  // Starts as after a power cycle: idle, in position control, with the saved speed limit and no
  // error.
  void boot(hal::TimeNs now_ns);
  // Restarts watchdog and messages; the position's zero is where the encoder starts to count.
  void start_counting(hal::TimeNs now_ns);
  // Returns the reported position in turns.
  [[nodiscard]] double position_turns() const;
  [[nodiscard]] bool is_0_6() const { return config_.firmware == ODriveFirmware::v0_6; }

  static constexpr double kTurnsPerRad = 0.5 / std::numbers::pi;
  static constexpr std::uint32_t kIdle = 1;
  static constexpr std::uint32_t kClosedLoop = 8;

  ODriveEmulatorConfig config_;
  // The shaft's turns at which the position is 0.
  double zero_turns_ = 0.0;
  // The axis state, kIdle or kClosedLoop.
  std::uint32_t state_ = kIdle;
  HostSettings host_;
  Errors errors_;
  // When the host last fed the watchdog.
  hal::TimeNs fed_ns_ = 0;
  NextMessages next_;
};

}  // namespace tactus::host
