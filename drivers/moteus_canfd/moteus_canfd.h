// A moteus servo in torque control over CAN FD.
//
// The bring-up sends stop frames until the servo is stopped and has no fault. Then it sends torque
// frames of zero until the servo is in position mode, which is pure torque because all gains are
// zero. From then on a torque goes out every tick and feeds the servo's watchdog.
//
// The bring-up proves the watchdog before the first torque. In position mode at zero torque it
// sends only queries until the servo reports its time-out; then the servo is stopped and started
// again.
//
// `power_off` stops the servo, so the bridge is off. `enable` false alone is zero torque in
// position mode. After a fault a stop frame goes out every tick. It also ends a fault or a time-out
// of the servo; the driver keeps the fault latched until clear_faults.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "drivers/axis.h"
#include "drivers/can_drive.h"
#include "drivers/common/continuity.h"
#include "drivers/common/encoder_check.h"
#include "drivers/common/fault_latch.h"
#include "drivers/common/repeat_timer.h"
#include "drivers/moteus_canfd/moteus_config.h"
#include "drivers/moteus_canfd/moteus_protocol.h"
#include "hal/can_frame.h"
#include "hal/clock.h"

namespace tactus::drivers {

// Other values of the servo's replies; zero until the servo sends them.
struct MoteusReadings {
  double voltage_V = 0.0;
  double temperature_C = 0.0;
  std::uint8_t limit = 0;       // 96 to 103: a limit on the torque, moteus::is_limit; else 0
  std::uint8_t home_state = 0;  // 0: relative, 1: within a turn of the rotor, 2: at the output
  std::uint32_t malformed = 0;  // replies without mode, position or velocity
};

// A CanDrive. Its status bits:
//   kDeviceNotReady      from start until torque mode
//   kDeviceStale         no reply for reply_stale_s; not latched
//   kDeviceLost          no reply in time
//   kDeviceDriveFault    a fault code, the watchdog's time-out, a refused register, or an end of
//                        torque mode
//   kDeviceTooHot        beside it, if the fault code is an over-temperature
//   kDeviceReferenceLost beside kDeviceLost and kDeviceEncoderFault, with a fault of supply or
//                        encoder, with 'stopped' during torque mode, and with a home state that
//                        falls; also after another fault, since a failed servo is still watched
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
  [[nodiscard]] Trouble trouble() const { return faults_.trouble(); }
  // Leaves an axis without a fault alone.
  void clear_faults(hal::TimeNs now_ns);
  void shutdown(CanOutbox& outbox);

  [[nodiscard]] const MoteusReadings& readings() const { return readings_; }

 private:
  enum class Phase : std::uint8_t {
    off,
    stopping,  // until the servo is stopped and has no fault
    starting,  // until the servo is in position mode
    proving,   // no torque frames, until the watchdog trips
    up,
    resting,  // stopped, because the power is to be off
    failed,
  };

  // The phase, and its begin.
  struct Stage {
    Phase phase = Phase::off;
    hal::TimeNs begun_ns = 0;
  };

  // The newest replies.
  struct Heard {
    // The time of the newest reply with a good position.
    hal::TimeNs position_ns = 0;
    // The time of the newest reply of any kind.
    hal::TimeNs reply_ns = 0;
    // The servo has replied since `start`, or since the position was lost.
    bool has_replied = false;
    // The fault code in the newest reply; 0: none.
    std::uint8_t last_fault = 0;
  };

  // The newest frames to the servo.
  struct Sent {
    // The stop frames, which ask for a reply, of a servo that has not replied.
    RepeatTimer questions;
    // The time of the last torque frame.
    hal::TimeNs torque_ns = 0;
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
  AxisSample sample_;
  FaultLatch faults_;
  MoteusReadings readings_;

  Continuity known_;
  Stage stage_;
  Heard heard_;
  Sent sent_;
};

static_assert(CanDrive<MoteusCanFd>);

}  // namespace tactus::drivers
