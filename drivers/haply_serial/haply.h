// A Haply board of the first generation as a board of up to four axes: its motors with the encoders
// on their shafts. firmware/kinematics/five_bar.h makes positions and forces of two of them.
//
// Axis: the arm's angle, rad, counted from wherever the arm stands when the board is set up, which
// counts as home_rad; the torque is at the arm, N m. The encoders are incremental: nothing but a
// homing (drivers/homing.h: a known pose, or a hard stop) says where the arms are.
//
// The board answers each command of torques with the angles. `write` sends, and the next `read`
// takes the answer: its angles were true shortly after that `write`, which is the time they are
// given.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "drivers/axis.h"
#include "drivers/haply_serial/protocol.h"
#include "drivers/rate_filter.h"
#include "hal/serial_port.h"

namespace tactus::drivers {

struct HaplyAxisConfig {
  bool motor_counter_clockwise = false;
  bool encoder_counter_clockwise = false;
  double counts_per_turn = 13'824.0;
  double home_rad = 0.0;  // what the angle counts from when the board is set up
};

struct HaplyConfig {
  std::uint8_t device_id = 5;
  std::size_t axes = 2;  // 1 to kHaplyMaxAxes, on ports 1, 2... without a gap
  std::array<HaplyAxisConfig, kHaplyMaxAxes> axis{};
  // Besides the board's own limit, kHaplyTorqueLimit_Nm.
  double torque_limit_Nm = kHaplyTorqueLimit_Nm;
  double velocity_cutoff_Hz = 100.0;
  // No hand turns an arm faster; what looks faster is a damaged answer.
  double fastest_rad_per_s = 60.0;
  // How far the first answers may be from what the setup told the encoders to say.
  double home_tolerance_rad = 0.1;

  // True: the owner accepts that the board has no watchdog, and with it that the motors may
  // keep their torque when the host dies.
  bool unproven_watchdog = false;
};

// Real time: read, write. The axes are
//   kDeviceNotReady      while the board shows that it is one and is set up (some 50 ms)
//   kDeviceStale         when no answer came before the deadline, or one that cannot be true
//   kDeviceLost          latched: unplugged, it does not take commands, or three answers in a row
//   are
//                        missing
//   kDeviceEncoderFault  latched: three answers in a row that cannot be true, or a setup that it
//   took
//                        wrongly
//   kDeviceReferenceLost latched with both once the board was set up, and until it is set up again:
//   its encoders are told anew what to say
//   kDeviceDriveFault    latched at `start` without unproven_watchdog; nothing is sent
// From a latched fault on every command carries zero torque, as long as commands can be sent. The
// board has no watchdog: what happens to its last torque when the cable breaks is its own matter.
class Haply {
 public:
  // Both must outlive the driver; the port is open.
  Haply(hal::SerialPort& port, const hal::Clock& clock, const HaplyConfig& config);

  // drivers::Board
  [[nodiscard]] std::size_t axis_count() const { return config_.axes; }
  // The arms must stand still until it is up.
  void start();
  void read(std::span<AxisSample> samples, hal::TimeNs deadline_ns);
  void write(std::span<const AxisCommand> commands);
  // Sends nothing while the board is well: the encoders go on counting. After a fault it opens a
  // port whose device came back and sets the board up again, with the reference lost.
  void clear_faults();
  void stop();
  [[nodiscard]] Trouble trouble(std::size_t axis) const;

 private:
  enum class State : std::uint8_t { stopped, settling, running };
  // The board is first told to count from angles that nothing else would answer.
  enum class Identity : std::uint8_t { asked, shown };
  static constexpr std::size_t kRemembered = 16;
  using Torques = std::array<double, kHaplyMaxAxes>;

  void set_up();
  void forget_answers();
  [[nodiscard]] double told_rad(std::size_t axis) const;
  void exchange(hal::TimeNs deadline_ns);
  // One answer, if it is complete by the deadline.
  bool receive(hal::TimeNs deadline_ns);
  void drop_late_piece();
  void accept(const HaplyAngles& angles);
  void find_home(const HaplyAngles& angles);
  void believe(const HaplyAngles& angles);
  [[nodiscard]] bool moved_plausibly(const HaplyAngles& angles) const;
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
  hal::TimeNs settled_ns_ = 0;

  std::array<std::byte, haply_reply_bytes(kHaplyMaxAxes)> reply_{};
  std::size_t reply_size_ = 0;    // of the answer that is arriving
  std::uint32_t reply_late_ = 0;  // reads that it took without coming to its end

  // When the commands were sent whose answers have not come, oldest first.
  std::array<hal::TimeNs, kRemembered> sent_ns_{};
  std::uint32_t sent_ = 0;
  std::uint32_t answered_ = 0;

  struct Believed {
    HaplyAngles angles{};
    hal::TimeNs time_ns = 0;
  };
  Believed believed_;          // the newest
  Believed reference_;         // the newest of an older command: what a jump is measured from
  hal::TimeNs answer_ns_ = 0;  // when the command was sent that the last answer belongs to
  std::array<AxisSample, kHaplyMaxAxes> samples_{};
  std::array<RateFilter, kHaplyMaxAxes> rates_;
  std::uint32_t at_home_in_a_row_ = 0;
  bool set_up_ = false;          // the board has shown that it took the setup
  bool reference_lost_ = false;  // it was set up before, and is set up again
  Identity identity_ = Identity::asked;
  std::uint32_t starts_ = 0;

  // Of this read.
  bool fresh_ = false;
  bool unasked_ = false;  // an answer came that no command asked for
  Trouble doubt_;

  std::uint32_t bad_score_ = 0;  // rises with a bad read, falls more slowly with good ones
  std::uint32_t latched_ = kDeviceOk;
  Trouble trouble_;
};

static_assert(Board<Haply>);

}  // namespace tactus::drivers
