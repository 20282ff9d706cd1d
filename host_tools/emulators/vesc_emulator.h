// A VESC on a CAN bus, as its frames show it. Tests and `tactus emulate vesc` run it.
//
// It fakes the current command with and without off-delay, the dead zone below the smallest
// current, the command's time-out, the half second after a fault in which nothing is obeyed, status
// 1, 4 and 5 at set rates, PING, and the questions for the fault code and for the flags, each
// alone. After a loss of power (kPowerLoss_ns) the tachometer starts from zero. It does not fake
// other ways to command a motor (they take the torque away), answers of more than one frame, and a
// brake current after the time-out.
#pragma once

#include <cstdint>

#include "host_tools/emulators/can_emulator.h"

namespace tactus::host {

// The drive's settings and its motor.
struct VescEmulatorConfig {
  // Its number in the lowest byte of the CAN identifier.
  std::uint8_t vesc_id = 0;
  double torque_constant_Nm_per_A = 0.03;
  // Electrical turns in one turn of the shaft.
  std::uint8_t pole_pairs = 7;
  // Commands beyond are cut off.
  double max_current_A = 60.0;
  // Smaller currents count as zero, unless the command has an off-delay.
  double min_current_A = 0.05;
  // With the supply's 48 V it determines the duty that a current takes.
  double phase_resistance_ohm = 0.1;
  // The time for which it obeys a host that has fallen silent, as the driver's README asks to set
  // it; a VESC's default is one second. 0: for ever.
  hal::TimeNs timeout_ns = 20'000'000;
  // The time after a fault in which it obeys nothing.
  hal::TimeNs fault_stop_ns = 500'000'000;
  // The period of status 1 and 5; 0: off.
  hal::TimeNs status_period_ns = 5'000'000;
  // The period of status 4; 0: off.
  hal::TimeNs status_4_period_ns = 200'000'000;
  // False: only status 1 has `status_period_ns`, so the host gets no position.
  bool sends_status_5 = true;
};

// One drive. The setters play events that no bus message causes.
class VescEmulator final : public CanEmulator {
 public:
  VescEmulator(hal::CanBus& bus, std::uint32_t seed, const VescEmulatorConfig& config);

  // Opens or closes the kill switch; open, no current flows.
  void set_kill_switch(bool open) { kill_switch_open_ = open; }
  // Sets a fault by VESC's number; it lasts until the code is set to 0.
  void set_fault_code(std::uint8_t code) { fault_.lasting_code = code; }
  // Lets the tachometer slip by that many counts at once.
  void slip(std::int32_t counts) { offset_counts_ += counts; }
  // Sets the temperatures of transistors and motor that status 4 reports.
  void set_temperatures(double fet_C, double motor_C);

 private:
  // The last current command.
  struct Command {
    hal::TimeNs time_ns = 0;
    double current_A = 0.0;
    // Until then the command's off-delay keeps currents in the dead zone flowing.
    hal::TimeNs holds_until_ns = 0;
  };
  // The fault code by VESC's numbers; 0: none.
  struct Fault {
    std::uint8_t code = 0;
    // A code that does not end by itself; 0: none.
    std::uint8_t lasting_code = 0;
    // The end of the stop after a fault.
    hal::TimeNs stops_until_ns = 0;
  };
  // When the periodic messages were last sent.
  struct SentStatus {
    hal::TimeNs status_ns = 0;
    hal::TimeNs status_4_ns = 0;
  };
  // The temperatures that status 4 reports.
  struct Temperatures {
    double fet_C = 31.0;
    double motor_C = 28.5;
  };

  void take(hal::TimeNs now_ns, const hal::CanFrame& frame) override;
  void advance(const DriveRun& run) override;

  // Takes a command of a current in mA, with an off-delay in ms if the frame has six bytes.
  void take_current(hal::TimeNs now_ns, const hal::CanFrame& frame);
  // Answers a question for the fault code or for the flags; other questions have no answer.
  void answer(hal::TimeNs now_ns, const hal::CanFrame& frame);
  // Sends the periodic messages that are due.
  void send_due_status(hal::TimeNs now_ns);
  // Sends status 1: electrical speed in rpm, current in 0.1 A and duty in thousandths.
  void send_status(hal::TimeNs now_ns);
  // Sends status 4: temperatures in 0.1 degrees C, input current in 0.1 A and position in 0.02
  // degrees.
  void send_status_4(hal::TimeNs now_ns);
  // Sends status 5: tachometer and supply voltage in 0.1 V.
  void send_status_5(hal::TimeNs now_ns);
  // Returns the tachometer's count: 0 is angle 0 or, after a power cycle, where the shaft was at
  // its end.
  [[nodiscard]] std::int32_t shaft_counts() const;
  // Returns true if no current has been commanded for the configured time.
  [[nodiscard]] bool has_timed_out(hal::TimeNs now_ns) const;
  // Returns the current that flows, A: the commanded one, or 0 under a fault, the kill switch, a
  // time-out or in the dead zone.
  [[nodiscard]] double current_A(hal::TimeNs now_ns) const;

  VescEmulatorConfig config_;
  Command command_;
  Fault fault_;
  SentStatus sent_;
  Temperatures temperatures_;
  // Added to the tachometer, so that it starts at 0 after a power cycle.
  std::int32_t offset_counts_ = 0;
  // The current that flows since the last run.
  double flowing_A_ = 0.0;
  bool kill_switch_open_ = false;
};

}  // namespace tactus::host
