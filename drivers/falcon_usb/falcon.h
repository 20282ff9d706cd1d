// The Novint Falcon as a board of three axes: its arms top, right and left, as the user sees them.
//
// An axis has the arm's angle from the base plane, in rad, growing toward the user, and the torque
// at the arm, in N m. firmware/kinematics/delta.h converts them to positions and forces.
//
// The device answers each packet of motor values with a packet of encoder counts. `write` sends,
// and the next `read` takes the answer. Its positions were true shortly after that `write`, whose
// time they get. Transfers stay in flight, so that no tick waits for the bus twice.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "drivers/axis.h"
#include "drivers/common/fault_latch.h"
#include "drivers/common/read_judge.h"
#include "drivers/falcon_usb/answers.h"
#include "drivers/falcon_usb/arms.h"
#include "drivers/falcon_usb/bring_up.h"
#include "drivers/falcon_usb/link.h"
#include "drivers/falcon_usb/packet.h"
#include "hal/usb_endpoint.h"

namespace tactus::drivers {

// The ids and addresses with which the endpoint must be opened.
inline constexpr std::uint16_t kFalconVendor = 0x0403;
inline constexpr std::uint16_t kFalconProduct = 0xCB48;
inline constexpr std::uint8_t kFalconEndpointOut = 0x02;
inline constexpr std::uint8_t kFalconEndpointIn = 0x81;

// The settings of one Falcon.
struct FalconConfig {
  // The image to upload when the device has none; it must outlive the driver. Empty: there is none.
  std::span<const std::byte> firmware;
  // Motor units for 1 N m at the arm. Nobody has published a calibrated value. This one is that of
  // libnifalcon; a fit of Novint's own packets gives about 3400. Calibrate before you trust forces.
  double motor_units_per_Nm = 10'000.0;
  // The largest torque at the arm. The device's own limit, kFalconMotorLimit / motor_units_per_Nm,
  // applies too.
  double torque_limit_Nm = 0.4095;
  double velocity_cutoff_Hz = 100.0;
  // No hand turns an arm faster. A faster motion is a damaged packet.
  double fastest_rad_per_s = 60.0;

  // True: the owner accepts that no watchdog of the device was proven, so that the motors may keep
  // their torque when the host dies.
  bool unproven_watchdog = false;
};

// Calls are real time once the device is up. Before that a read takes as long as a control request,
// some milliseconds. `clear_faults` also opens a device that came back, and is not real time.
//
// The status of the axes:
//   kDeviceNotReady      while the device is set up and its firmware uploaded (some seconds)
//   kDeviceHoming        without torque, until the user has pulled the grip out and pushed it in
//   kDeviceStale         if no answer came before the deadline, or an impossible one
//   kDeviceLost          latched: unplugged, a transfer failed, or three answers in a row are
//                        missing
//   kDeviceEncoderFault  latched: three impossible answers in a row, or the reference was lost
//   kDeviceDriveFault    latched: the bring-up failed, or unproven_watchdog is false
//   kDeviceReferenceLost latched with every fault of a device that was homed, until its own
//                        homing bits are all there again
// After a latched fault every packet carries zero torque, as long as packets can be sent.
class Falcon {
 public:
  // The endpoint and the clock must outlive the driver. The endpoint is open.
  Falcon(hal::UsbEndpoint& endpoint, const hal::Clock& clock, const FalconConfig& config);

  // These are the calls of drivers::Board.
  [[nodiscard]] static std::size_t axis_count() { return kFalconArms; }
  void start();
  void read(std::span<AxisSample> samples, hal::TimeNs deadline_ns);
  void write(std::span<const AxisCommand> commands);
  // Leaves a device without a fault alone. After a fault it brings the device up again.
  void clear_faults();
  void stop();
  [[nodiscard]] Trouble trouble(std::size_t axis) const;

  // Returns FalconButton bits; 0 while they are not known.
  [[nodiscard]] std::uint8_t buttons() const {
    return state_ == State::running && !faults_ ? newest_.buttons : std::uint8_t{0};
  }
  [[nodiscard]] const FalconBringUp& bring_up() const { return bring_up_; }
  // Returns the motor units in the packet that was sent last.
  [[nodiscard]] const std::array<std::int16_t, kFalconArms>& motors() const {
    return newest_.motors;
  }

 private:
  enum class State : std::uint8_t { stopped, coming_up, running };

  // The content of the newest packets from the device and to it.
  struct Newest {
    std::uint8_t buttons = 0;
    std::array<std::int16_t, kFalconArms> motors{};
  };

  void come_up(hal::TimeNs deadline_ns);
  bool act(const FalconBringUp::Action& action);
  void note_outcome();
  void exchange(hal::TimeNs deadline_ns);
  void drain();
  void judge();

  // Receives one packet. Returns false if none comes by the deadline.
  bool receive(hal::TimeNs deadline_ns);
  void take(std::span<const std::byte> payload);
  void accept(const FalconAnswer& answer);
  void believe(const FalconAnswer& answer);

  void send(const FalconCommand& command);
  [[nodiscard]] std::int16_t motor_units(const AxisCommand& command) const;
  [[nodiscard]] FalconLights lights(bool powered) const;

  void latch(std::uint32_t status, const Trouble& trouble);
  // Latches the loss of the device if a transfer failed.
  void check(const hal::Result<void>& outcome);
  void lose(const hal::Error& error);
  [[nodiscard]] std::uint32_t status() const;

  const hal::Clock* clock_;
  FalconConfig config_;
  FalconLink link_;
  FalconBringUp bring_up_;
  State state_ = State::stopped;
  FalconAnswers answers_;
  FalconArms arms_;
  ReadJudge reads_;
  FaultLatch faults_;
  Newest newest_;
};

static_assert(Board<Falcon>);

}  // namespace tactus::drivers
