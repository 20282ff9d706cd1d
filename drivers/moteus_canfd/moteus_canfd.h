// A moteus servo in torque control over CAN FD.
//
// Bring-up: stop frames until it is stopped and without fault; torque frames of zero until it is in
// position mode, which with all gains zero is pure torque. From then on a torque goes out every
// tick and feeds the servo's watchdog.
// Before the first torque the watchdog is proven: in position mode at zero torque only queries go
// out until the servo says that it timed out, then it is stopped and started again.
// `power_off` stops the servo (bridge off); `enable` false alone is zero torque in position mode.
// From a fault on: a stop frame every tick, which also ends a servo's own fault or time-out; the
// fault stays latched here until clear_faults.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "drivers/axis.h"
#include "drivers/can_drive.h"
#include "drivers/encoder_check.h"
#include "drivers/moteus_canfd/moteus_config.h"
#include "drivers/moteus_canfd/moteus_protocol.h"
#include "hal/can_frame.h"
#include "hal/clock.h"

namespace tactus::drivers {

// Further values of the servo's replies; zero if it has not sent them.
struct MoteusReadings {
  double voltage_V = 0.0;
  double temperature_C = 0.0;
  std::uint8_t limit = 0;       // 96 to 103: a limit on the torque, moteus::is_limit; else 0
  std::uint8_t home_state = 0;  // 0: relative, 1: within a turn of the rotor, 2: at the output
  std::uint32_t malformed = 0;  // replies that lacked mode, position or velocity
};

// A CanDrive. Status bits:
//   kDeviceNotReady      from start until torque mode
//   kDeviceStale         no reply for reply_stale_s; not latched
//   kDeviceLost          no reply in time
//   kDeviceDriveFault    a fault code, the watchdog's time-out, a refused register, or torque mode
//                        left
//   kDeviceTooHot        with it, if that is what the fault code says
//   kDeviceReferenceLost with lost and encoder fault, with a fault of supply or encoder, with
//   torque
//                        mode left for 'stopped', and with a home state that falls; also after
//                        another fault, since a failed servo goes on being watched
//   kDeviceEncoderFault  a position that is not a number or that no shaft can have reached
// With the last four the sample keeps the last good position.
class MoteusCanFd {
 public:
  // The configuration has passed `check`.
  explicit MoteusCanFd(const MoteusConfig& config);

  std::size_t filters(std::span<hal::CanFilter> filters) const;
  void start(hal::TimeNs now_ns);
  void take(const hal::CanReceived& received);
  void request(hal::TimeNs now_ns, CanOutbox& outbox);
  void command(hal::TimeNs now_ns, const AxisCommand& command, CanOutbox& outbox);
  [[nodiscard]] const AxisSample& sample() const { return sample_; }
  [[nodiscard]] Trouble trouble() const { return trouble_; }
  // Without effect on an axis that is well.
  void clear_faults(hal::TimeNs now_ns);
  void shutdown(CanOutbox& outbox);

  [[nodiscard]] const MoteusReadings& readings() const { return readings_; }

 private:
  enum class Phase : std::uint8_t {
    off,
    stopping,  // until it is stopped and without fault
    starting,  // until it is in position mode
    proving,   // no torque frames, until the watchdog trips
    up,
    resting,  // stopped, since the power is to be off
    failed,
  };

  void begin(hal::TimeNs now_ns);
  void enter(Phase phase, hal::TimeNs now_ns);
  void switch_power(bool power_off, hal::TimeNs now_ns);
  void fail(std::uint32_t status, const Trouble& trouble);
  void watch_deadlines(hal::TimeNs now_ns);
  void watch_bring_up(hal::TimeNs now_ns);
  void watch_samples(hal::TimeNs now_ns);
  void watch_proof(hal::TimeNs now_ns);
  void take_reply(const moteus::Reply& reply, hal::TimeNs time_ns);
  void take_position(const moteus::Reply& reply, hal::TimeNs time_ns);
  void take_home_state(std::optional<std::uint8_t> home_state);
  void take_proof(moteus::Mode mode, std::uint8_t fault, hal::TimeNs time_ns);
  void take_mode(std::uint8_t mode, std::uint8_t fault, hal::TimeNs time_ns);
  void take_mode_under_torque(moteus::Mode mode, std::uint8_t fault, hal::TimeNs time_ns);
  [[nodiscard]] bool is_time_to_ask(hal::TimeNs now_ns);

  MoteusConfig config_;
  moteus::Address address_;
  EncoderCheck encoder_;
  Phase phase_ = Phase::off;
  AxisSample sample_;
  Trouble trouble_;
  MoteusReadings readings_;

  hal::TimeNs phase_since_ns_ = 0;
  hal::TimeNs reply_ns_ = 0;  // the newest with a good position
  hal::TimeNs heard_ns_ = 0;  // the newest of any kind
  hal::TimeNs asked_ns_ = 0;
  hal::TimeNs fed_ns_ = 0;  // the last torque frame
  std::uint8_t last_fault_ = 0;
  bool has_asked_ = false;    // since start
  bool has_replied_ = false;  // since start
  bool is_followed_ = false;  // the position, since the axis was up
  bool is_proven_ = false;    // the watchdog, and the reference has not been lost since
  bool is_shown_ = true;      // the loss of the reference, by a read
};

static_assert(CanDrive<MoteusCanFd>);

}  // namespace tactus::drivers
