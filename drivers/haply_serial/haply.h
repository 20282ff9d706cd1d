// A Haply board of the first generation as a board of up to four axes: its motors with the encoders
// on their shafts. firmware/kinematics/five_bar.h converts two of them to positions and forces.
//
// An axis has the arm's angle, in rad, and the torque at the arm, in N m. The angle is home_rad
// where the arm stands when the board is set up. The encoders are incremental, so only homing
// (drivers/composition/homing.h: a known pose, or a hard stop) finds the positions of the arms.
//
// The board answers each command of torques with the angles. `write` sends, and the next `read`
// takes the answer. Its angles were true shortly after that `write`, whose time they get.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "drivers/axis.h"
#include "drivers/common/fault_latch.h"
#include "drivers/common/last_readings.h"
#include "drivers/common/position_samples.h"
#include "drivers/common/read_judge.h"
#include "drivers/haply_serial/answers.h"
#include "drivers/haply_serial/protocol.h"
#include "hal/serial_port.h"

namespace tactus::drivers {

// The settings of one axis of the board.
struct HaplyAxisConfig {
  bool motor_counter_clockwise = false;
  bool encoder_counter_clockwise = false;
  double counts_per_turn = 13'824.0;
  double home_rad = 0.0;  // the angle when the board is set up
};

// The settings of one board.
struct HaplyConfig {
  std::uint8_t device_id = 5;
  std::size_t axes = 2;  // 1 to kHaplyMaxAxes, on ports 1, 2... without a gap
  std::array<HaplyAxisConfig, kHaplyMaxAxes> axis{};
  // The largest torque at the arm. The board's own limit, kHaplyTorqueLimit_Nm, applies too.
  double torque_limit_Nm = kHaplyTorqueLimit_Nm;
  double velocity_cutoff_Hz = 100.0;
  // No hand turns an arm faster. A faster motion is a damaged answer.
  double fastest_rad_per_s = 60.0;
  // The largest error of the first answers against the angles that the setup told the encoders.
  double home_tolerance_rad = 0.1;

  // True: the owner accepts that the board has no watchdog, so that the motors may keep their
  // torque when the host dies.
  bool unproven_watchdog = false;
};

// read and write are real time. The status of the axes:
//   kDeviceNotReady      while the board is identified and set up (some 50 ms)
//   kDeviceStale         if no answer came before the deadline, or an impossible one
//   kDeviceLost          latched: unplugged, it does not take commands, or three answers in a
//                        row are missing
//   kDeviceEncoderFault  latched: three impossible answers in a row, or it took the setup
//                        wrongly
//   kDeviceReferenceLost latched with these two once the board was set up, until it is set up
//                        again, since the setup sets the encoders' angles anew
//   kDeviceDriveFault    latched at `start` without unproven_watchdog; nothing is sent
// After a latched fault every command carries zero torque, as long as commands can be sent. The
// board has no watchdog, so the driver cannot end its last torque when the cable breaks.
class Haply {
 public:
  // The port and the clock must outlive the driver. The port is open.
  Haply(hal::SerialPort& port, const hal::Clock& clock, const HaplyConfig& config);

  // These are the calls of drivers::Board.
  [[nodiscard]] std::size_t axis_count() const { return config_.axes; }
  // Starts to set the board up. The arms must stand still until it is ready.
  void start();
  void read(std::span<AxisSample> samples, hal::TimeNs deadline_ns);
  void write(std::span<const AxisCommand> commands);
  // Sends nothing to a board without a fault; the encoders go on counting. After a fault it opens a
  // port whose device came back and sets the board up again, with the reference lost.
  void clear_faults();
  void stop();
  [[nodiscard]] Trouble trouble(std::size_t axis) const;

 private:
  enum class State : std::uint8_t { stopped, settling, running };
  // The setup first tells the board to count from angles that no other device would answer with.
  enum class Identity : std::uint8_t { asked, shown };
  using Torques = std::array<double, kHaplyMaxAxes>;

  // The setup of the board, which its answers must show.
  struct Setup {
    // The number of starts, from which the angles of an identity that is asked for differ.
    std::uint32_t starts = 0;
    Identity identity = Identity::asked;
    // The time from which the board answers.
    hal::TimeNs settled_ns = 0;
    // The number of answers in a row that say what the setup told.
    std::uint32_t at_home_in_a_row = 0;
    // The board's answers show that it took the setup.
    bool is_done = false;
    // The board was set up before, and is set up again.
    bool is_reference_lost = false;
  };

  void set_up();
  void forget_answers();
  [[nodiscard]] double told_rad(std::size_t axis) const;
  void exchange(hal::TimeNs deadline_ns);
  // Receives one answer. Returns false if none is complete by the deadline.
  bool receive(hal::TimeNs deadline_ns);
  void drop_late_piece();
  void take(std::span<const std::byte> reply, hal::TimeNs asked_ns);
  void accept(const HaplyAngles& angles, hal::TimeNs asked_ns);
  void find_home(const HaplyAngles& angles, hal::TimeNs asked_ns);
  void believe(const HaplyAngles& angles, hal::TimeNs asked_ns);
  [[nodiscard]] bool moved_plausibly(const HaplyAngles& angles, hal::TimeNs asked_ns) const;
  [[nodiscard]] bool says_what_it_was_told(const HaplyAngles& angles) const;
  void judge();

  bool send(const HaplyMessage& message, hal::TimeNs deadline_ns);
  void send_torques(const Torques& torque_Nm);
  void latch(std::uint32_t status, const Trouble& trouble);
  void lose(const hal::Error& error);
  [[nodiscard]] std::uint32_t status() const;

  hal::SerialPort* port_;
  const hal::Clock* clock_;
  HaplyConfig config_;
  State state_ = State::stopped;
  Setup setup_;
  HaplyAnswers answers_;
  LastReadings<HaplyAngles> last_;
  PositionSamples<kHaplyMaxAxes> samples_;
  ReadJudge reads_;
  FaultLatch faults_;
};

static_assert(Board<Haply>);

}  // namespace tactus::drivers
