// The Novint Falcon as a board of three axes: the arms, top, right and left as the user sees them.
//
// Axis: the arm's angle from the base plane, rad, growing toward the user; the torque is at the
// arm, N m. firmware/kinematics/delta.h makes positions and forces of them.
//
// The device answers each packet of motor values with one of encoder counts. `write` sends, and the
// next `read` takes the answer: its positions were true shortly after that `write`, which is the
// time they are given. Transfers are kept in flight, so that no tick waits for the bus twice.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "drivers/axis.h"
#include "drivers/falcon_usb/bring_up.h"
#include "drivers/falcon_usb/packet.h"
#include "drivers/rate_filter.h"
#include "hal/usb_endpoint.h"

namespace tactus::drivers {

// What the endpoint must be opened with.
inline constexpr std::uint16_t kFalconVendor = 0x0403;
inline constexpr std::uint16_t kFalconProduct = 0xCB48;
inline constexpr std::uint8_t kFalconEndpointOut = 0x02;
inline constexpr std::uint8_t kFalconEndpointIn = 0x81;

struct FalconConfig {
  // The image to upload when the device has none; must outlive the driver. Empty: none.
  std::span<const std::byte> firmware;
  // Motor units for a newton-metre at the arm. Nobody has published a calibrated value: this is
  // libnifalcon's; a fit of Novint's own packets gives about 3400. Calibrate before trusting
  // forces.
  double motor_units_per_Nm = 10'000.0;
  // Besides the device's own limit, which is kFalconMotorLimit / motor_units_per_Nm.
  double torque_limit_Nm = 0.4095;
  double velocity_cutoff_Hz = 100.0;
  // No hand turns an arm faster; what looks faster is a damaged packet.
  double fastest_rad_per_s = 60.0;

  // True: the owner accepts that no watchdog of the device was proven, and with it that the motors
  // may keep their torque when the host dies.
  bool unproven_watchdog = false;
};

// Real time from the moment it is up: until then a read takes as long as a control request does,
// some milliseconds. `clear_faults` opens a device that came back, which is not real time either.
//
// The axes are
//   kDeviceNotReady      while the device is set up and its firmware uploaded (some seconds)
//   kDeviceHoming        until the user has pulled the grip out and pushed it in: no torque until
//   then kDeviceStale         when no answer came before the deadline, or one that cannot be true
//   kDeviceLost          latched: unplugged, a transfer failed, or three answers in a row are
//   missing kDeviceEncoderFault  latched: three in a row that cannot be true, or a reference lost
//   kDeviceDriveFault    latched: it could not be brought up, or unproven_watchdog is not said
//   kDeviceReferenceLost latched with every fault of a device that was homed, and until its own
//   homing bits are all there again
// From a latched fault on every packet carries zero torque, as long as packets can be sent.
class Falcon {
 public:
  // Both must outlive the driver; the endpoint is open.
  Falcon(hal::UsbEndpoint& endpoint, const hal::Clock& clock, const FalconConfig& config);
  Falcon(const Falcon&) = delete;
  Falcon& operator=(const Falcon&) = delete;
  ~Falcon();

  // drivers::Board
  [[nodiscard]] static std::size_t axis_count() { return kFalconArms; }
  void start();
  void read(std::span<AxisSample> samples, hal::TimeNs deadline_ns);
  void write(std::span<const AxisCommand> commands);
  // Does nothing to a device that is well. After a fault it brings the device up anew.
  void clear_faults();
  void stop();
  [[nodiscard]] Trouble trouble(std::size_t axis) const;

  // FalconButton bits; 0 while they are not known.
  [[nodiscard]] std::uint8_t buttons() const {
    return state_ == State::running && latched_ == kDeviceOk ? buttons_ : std::uint8_t{0};
  }
  [[nodiscard]] const FalconBringUp& bring_up() const { return bring_up_; }
  // Motor units in the packet sent last.
  [[nodiscard]] const std::array<std::int16_t, kFalconArms>& motors() const { return motors_; }

 private:
  enum class State : std::uint8_t { stopped, coming_up, running };
  static constexpr std::size_t kReadsInFlight = 4;
  static constexpr std::size_t kWritesInFlight = 2;
  static constexpr std::size_t kUsbPacketBytes = 64;
  static constexpr std::size_t kRemembered = 16;

  struct Read {
    std::array<std::byte, kUsbPacketBytes> buffer{};
    hal::UsbTransfer transfer = hal::UsbTransfer::in(buffer);
  };
  struct Write {
    FalconPacket packet{};
    hal::UsbTransfer transfer = hal::UsbTransfer::out(packet);
    bool on_its_way = false;  // submitted, and its outcome not looked at
  };

  void come_up(hal::TimeNs deadline_ns);
  bool act(const FalconBringUp::Action& action);
  void note_outcome();
  void exchange(hal::TimeNs deadline_ns);
  void drain();
  void judge();

  // One packet from the device, if it comes by the deadline.
  bool receive(hal::TimeNs deadline_ns);
  void take(std::span<const std::byte> payload);
  void accept(const FalconReply& reply);
  void believe(const FalconReply& reply);
  [[nodiscard]] bool moved_plausibly(const FalconReply& reply) const;
  void home_with(const FalconReply& reply);

  void submit(hal::UsbTransfer& transfer);
  void check_writes();
  void send(const FalconCommand& command);
  void withdraw_all();
  [[nodiscard]] std::int16_t motor_units(const AxisCommand& command) const;
  [[nodiscard]] FalconLights lights(bool powered) const;

  void latch(std::uint32_t status, const Trouble& trouble);
  void lose(const hal::Error& error);
  [[nodiscard]] std::uint32_t status() const;

  hal::UsbEndpoint* endpoint_;
  const hal::Clock* clock_;
  FalconConfig config_;
  FalconBringUp bring_up_;
  FalconPacketReader reader_;
  State state_ = State::stopped;

  std::array<Read, kReadsInFlight> reads_;
  std::size_t next_read_ = 0;
  std::array<Write, kWritesInFlight> writes_;
  std::size_t next_write_ = 0;

  // When the packets were sent whose answers have not come, oldest first.
  std::array<hal::TimeNs, kRemembered> sent_ns_{};
  std::uint32_t sent_ = 0;
  std::uint32_t answered_ = 0;
  std::size_t payload_bytes_ = 0;  // of the answer that is arriving

  std::array<AxisSample, kFalconArms> samples_{};
  std::array<RateFilter, kFalconArms> rates_;
  struct Believed {
    std::array<std::int16_t, kFalconArms> counts{};
    hal::TimeNs time_ns = 0;
  };
  Believed believed_;          // the newest
  Believed reference_;         // the newest of an older packet: what a jump is measured from
  hal::TimeNs answer_ns_ = 0;  // when the packet was sent that the last answer belongs to
  bool homed_ = false;
  bool reference_lost_ = false;  // it was homed before the fault that was cleared
  std::uint32_t homed_in_a_row_ = 0;
  std::uint8_t buttons_ = 0;
  std::array<std::int16_t, kFalconArms> motors_{};

  // Of this read.
  bool fresh_ = false;    // a believable answer came
  bool payload_ = false;  // anything came
  Trouble doubt_;         // why an answer was not believed

  std::uint32_t bad_score_ = 0;  // rises with a bad read, falls more slowly with good ones
  std::uint32_t blocked_in_a_row_ = 0;

  std::uint32_t latched_ = kDeviceOk;
  Trouble trouble_;
};

static_assert(Board<Falcon>);

}  // namespace tactus::drivers
