// A device composed of boards. For each joint it knows which axis of which board senses it and
// which one moves it. It satisfies drivers::Device, so the controller sees only joints.
//
// read   takes every board's newest samples within one deadline and converts them to positions,
//        velocities and ages of joints
// write  converts joint efforts to torques at the motors' shafts, clamps them and sends them
//
// During homing (`command.home`) the motors follow the searches of the joints instead. A fault of
// any axis counts for the whole device: all motors lose their power.
//
// A joint loses its reference when its encoder's axis reports kDeviceReferenceLost,
// kDeviceEncoderFault or kDeviceLost, also beside other faults and long after them. clear_faults
// does not restore it; only homing does. A joint with an absolute reference keeps it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "drivers/axis.h"
#include "drivers/composition/board_ref.h"
#include "drivers/composition/homing.h"
#include "drivers/composition/transmission.h"
#include "drivers/device.h"
#include "hal/clock.h"

namespace tactus::drivers {

inline constexpr std::size_t kMaxBoards = kMaxJoints;

// The address of an axis: its board, in the order of add_board, and its number on that board.
struct AxisAddress {
  std::size_t board = 0;
  std::size_t axis = 0;
};

// The axes of one joint and the conversion between them and the joint.
struct JointWiring {
  std::string_view name;  // for messages; must outlive the device
  AxisAddress encoder;
  AxisAddress motor;
  Transmission transmission;
  Reference reference;
  double max_torque_Nm = 0.0;  // at the motor's shaft; larger commands are clamped
};

// A fault and the name of the joint that has it.
struct JointTrouble {
  std::string_view joint;
  Trouble trouble;
};

// A Device. No two calls may run at the same time.
class ComposedDevice {
 public:
  // `read` waits for fresh samples for read_limit_ns at most. The clock must outlive the device.
  ComposedDevice(const hal::Clock& clock, hal::TimeNs read_limit_ns)
      : clock_(&clock), read_limit_ns_(read_limit_ns) {}

  // These two are called before `start`. They return false if there is no room, if the wiring names
  // an axis that does not exist, or if one of its numbers is out of range.
  bool add_board(const BoardRef& board);
  bool add_joint(const JointWiring& wiring);

  // These two are not real time.
  void start();
  void stop();

  // These are the calls of drivers::Device.
  [[nodiscard]] std::size_t joint_count() const { return joint_count_; }
  void read(JointSample& sample);
  std::uint32_t write(const JointCommand& command);
  void clear_faults();

  // Returns the fault of the joint that had one first, in the newest words of its board, or an
  // empty one if all is well. It is latched until clear_faults.
  [[nodiscard]] JointTrouble trouble() const { return trouble_; }
  // Returns the first joint that must be homed again, with the fault that its encoder's board
  // reported when the reference was lost. Empty if there is none. clear_faults keeps it; homing
  // that joint removes it.
  [[nodiscard]] JointTrouble lost_reference() const;
  // These return values of the last tick for a log: the sample of the encoder's shaft, and the
  // torque that was commanded to the motor (N m).
  [[nodiscard]] const AxisSample& encoder_sample(std::size_t joint) const;
  [[nodiscard]] double commanded_torque_Nm(std::size_t joint) const;

 private:
  static constexpr std::size_t kNoJoint = kMaxJoints;

  struct Joint {
    JointWiring wiring;
    Homing homing;
    Trouble why_lost;                // the cause of a lost reference; empty if none was lost
    hal::TimeNs torque_time_ns = 0;  // the time of the last measured torque
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
