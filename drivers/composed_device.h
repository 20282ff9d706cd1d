// A device made of boards: which axis of which board senses and moves each joint. Satisfies
// drivers::Device, so the controller sees joints and nothing else.
//
// read   every board's newest samples within one deadline -> joint positions, velocities, age
// write  joint efforts -> torques at the motors' shafts, clamped -> every board
// While the controller is homing (`command.home`) the motors follow the joints' searches instead.
// Trouble of any axis is the whole device's: all motors lose their power.
//
// A joint's reference is lost for good when its encoder's axis reports kDeviceReferenceLost,
// kDeviceEncoderFault or kDeviceLost, also beside other faults and long after them. clear_faults
// does not bring it back, only homing does; a joint with an absolute reference keeps it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "drivers/axis.h"
#include "drivers/board_ref.h"
#include "drivers/device.h"
#include "drivers/homing.h"
#include "drivers/transmission.h"
#include "hal/clock.h"

namespace tactus::drivers {

inline constexpr std::size_t kMaxBoards = kMaxJoints;

// An axis of one of the device's boards, in the order of adding.
struct AxisAddress {
  std::size_t board = 0;
  std::size_t axis = 0;
};

struct JointWiring {
  std::string_view name;  // for messages; outlives the device
  AxisAddress encoder;
  AxisAddress motor;
  Transmission transmission;
  Reference reference;
  double max_torque_Nm = 0.0;  // at the motor's shaft; never more is commanded
};

// What is wrong, and with which joint.
struct JointTrouble {
  std::string_view joint;
  Trouble trouble;
};

class ComposedDevice {
 public:
  // `read` waits no longer than this for fresh samples.
  ComposedDevice(const hal::Clock& clock, hal::TimeNs read_limit_ns)
      : clock_(&clock), read_limit_ns_(read_limit_ns) {}

  // Before `start`. False when there is no room, or the wiring names an axis that is not there, or
  // its numbers are out of range.
  bool add_board(const BoardRef& board);
  bool add_joint(const JointWiring& wiring);

  // Not real time.
  void start();
  void stop();

  // Device.
  [[nodiscard]] std::size_t joint_count() const { return joint_count_; }
  void read(JointSample& sample);
  std::uint32_t write(const JointCommand& command);
  void clear_faults();

  // Of the joint that was first in trouble, in its board's newest words; empty if all is well.
  // Latched until clear_faults.
  [[nodiscard]] JointTrouble trouble() const { return trouble_; }
  // The first joint that must be homed again, and what its encoder's board said when the reference
  // went; empty when there is none. Stays over clear_faults until that joint is homed.
  [[nodiscard]] JointTrouble lost_reference() const;
  // The last tick's, for a log: shaft angles, and what was asked of the motors.
  [[nodiscard]] const AxisSample& encoder_sample(std::size_t joint) const;
  [[nodiscard]] double commanded_torque_Nm(std::size_t joint) const;

 private:
  static constexpr std::size_t kNoJoint = kMaxJoints;

  struct Joint {
    JointWiring wiring;
    Homing homing;
    Trouble why_lost;  // the reference; empty: it is there, or never was
  };
  struct BoardState {
    BoardRef ref;
    std::array<AxisSample, kMaxJoints> samples{};
    std::array<AxisCommand, kMaxJoints> commands{};
  };

  [[nodiscard]] bool exists(const AxisAddress& address) const;
  [[nodiscard]] const AxisSample& sample_at(const AxisAddress& address) const;
  std::uint32_t read_joint(std::size_t i, hal::TimeNs now_ns, JointSample& sample);
  std::uint32_t follow_reference(std::size_t i);
  [[nodiscard]] Trouble trouble_at(const AxisAddress& address) const;
  void note_trouble(std::size_t i);

  const hal::Clock* clock_;
  hal::TimeNs read_limit_ns_;
  std::array<BoardState, kMaxBoards> boards_{};
  std::array<Joint, kMaxJoints> joints_{};
  std::size_t board_count_ = 0;
  std::size_t joint_count_ = 0;
  bool home_ = false;  // the controller wants the reference
  std::uint32_t latched_ = kDeviceOk;
  JointTrouble trouble_;
  std::size_t troubled_joint_ = kNoJoint;
};

static_assert(Device<ComposedDevice>);

}  // namespace tactus::drivers
