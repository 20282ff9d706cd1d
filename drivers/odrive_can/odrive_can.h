// An ODrive axis, firmware 0.5.x or 0.6.x, in torque mode over CANSimple.
//
// The bring-up waits for a heartbeat and asks for the version, which only 0.6 answers. It sets the
// axis idle, clears errors, sets torque mode and limits, and asks for closed loop. In closed loop
// at zero torque it sends nothing until the drive's watchdog has stopped the motor and the drive
// has reported that. Then it clears errors and asks for closed loop again, and trusts it after two
// heartbeats 150 ms apart. A drive that goes on without commands is refused. In all other phases a
// torque goes out every tick, zero until the axis is up, and feeds the drive's watchdog.
//
// `power_off` makes the axis idle; without it the axis comes up again. After a fault each tick
// sends torque zero and repeats the request for idle, until clear_faults. A failed axis is still
// watched, because its position may be lost later.
//
// The position is followed from the first time that the axis was up, also through faults and
// bring-ups, without a gap longer than estimate_lost_s. A drive that restarts counts from another
// zero.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "drivers/axis.h"
#include "drivers/can_drive.h"
#include "drivers/common/continuity.h"
#include "drivers/common/encoder_check.h"
#include "drivers/common/fault_latch.h"
#include "drivers/common/repeat_timer.h"
#include "drivers/odrive_can/odrive_config.h"
#include "drivers/odrive_can/odrive_protocol.h"
#include "hal/can_frame.h"
#include "hal/clock.h"

namespace tactus::drivers {

// Other values that the drive sent; zero until it sends them.
struct ODriveReadings {
  odrive::BusPower bus;
  odrive::Current current;
  odrive::Temperature temperature;
  std::uint32_t malformed = 0;  // frames of this node with a wrong length
};

// A CanDrive. Its status bits:
//   kDeviceNotReady       from start until closed loop
//   kDeviceStale          no estimate for estimate_stale_s; not latched
//   kDeviceLost           no heartbeat or no estimate in time
//   kDeviceDriveFault     an error bit, a refused bring-up, or an end of closed loop
//   kDeviceEmergencyStop  beside it, if the drive reports an emergency stop
//   kDeviceTooHot         beside it, if the drive reports over-temperature
//   kDeviceEncoderFault   a position that is not a number or that no shaft can have reached
//   kDeviceReferenceLost  beside kDeviceLost and kDeviceEncoderFault; with an error of supply or
//                         encoder; and with an error that went away or a closed loop that ended
//                         without a cause, as in a restart
// With all but the first two the sample keeps the last good position.
class ODriveCan {
 public:
  // The configuration has passed `check`.
  explicit ODriveCan(const ODriveConfig& config);

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

  [[nodiscard]] odrive::Generation generation() const { return session_.generation; }
  [[nodiscard]] const ODriveReadings& readings() const { return session_.readings; }

 private:
  enum class Phase : std::uint8_t {
    off,
    listening,  // for the first heartbeat
    probing,    // for the version
    settling,   // idle, errors cleared, torque mode
    arming,     // asks for closed loop
    proving,    // silent in closed loop, until the watchdog trips
    up,
    resting,  // idle, because the power is to be off
    failed,
  };

  // The phase and the progress in it. Each phase begins with a fresh one.
  struct Stage {
    Phase phase = Phase::off;
    hal::TimeNs begun_ns = 0;
    // The frames that the phase repeats, and the time of the first one.
    RepeatTimer repeats;
    hal::TimeNs first_sent_ns = 0;
    // While arming: the drive is in closed loop in the newest heartbeat, and since when.
    bool is_closed = false;
    hal::TimeNs closed_since_ns = 0;
    // While arming: the number of heartbeats in a row that refuse closed loop.
    std::uint32_t refused_in_a_row = 0;
  };

  // The knowledge of the drive from the begin of a bring-up to the next one.
  struct Session {
    odrive::Generation generation = odrive::Generation::unknown;
    ODriveReadings readings;
    // The error in the newest heartbeat.
    std::uint32_t last_error = 0;
    // The number of proofs of the watchdog that were begun.
    std::uint32_t proofs = 0;
    // The driver must ask for the cause of the fault.
    bool wants_explanation = false;
  };

  // The times at which the drive last reported this.
  struct Heard {
    hal::TimeNs heartbeat_ns = 0;
    hal::TimeNs estimate_ns = 0;
  };

  // The questions that are asked in turn.
  struct Polls {
    hal::TimeNs polled_ns = 0;
    // The index of the next question.
    std::size_t next = 0;
    // The time of the last question for the torque.
    hal::TimeNs torque_polled_ns = 0;
  };

  void begin(hal::TimeNs now_ns);
  void enter(Phase phase, hal::TimeNs now_ns);
  void fail(std::uint32_t status, const Trouble& trouble);
  void watch_deadlines(hal::TimeNs now_ns);
  void watch_samples(hal::TimeNs now_ns);
  void watch_bring_up(hal::TimeNs now_ns);
  void watch_silence(hal::TimeNs now_ns);
  void watch_proof(hal::TimeNs now_ns);

  void take_heartbeat(const odrive::Heartbeat& heartbeat, hal::TimeNs time_ns);
  void take_while_arming(const odrive::Heartbeat& heartbeat, hal::TimeNs time_ns);
  void take_while_proving(const odrive::Heartbeat& heartbeat, hal::TimeNs time_ns);
  void take_while_resting(const odrive::Heartbeat& heartbeat, hal::TimeNs time_ns);
  void take_while_failed(const odrive::Heartbeat& heartbeat, std::uint32_t error_before);
  void take_estimates(const odrive::Estimates& estimates, hal::TimeNs time_ns);
  void take_torque(double torque_Nm, hal::TimeNs time_ns);
  void take_reply(const hal::CanFrame& frame, hal::TimeNs time_ns);
  void take_reply_0_5(const hal::CanFrame& frame);
  void take_reply_0_6(const hal::CanFrame& frame, hal::TimeNs time_ns);
  void fail_by_error(std::uint32_t error);
  void explain(const Trouble& trouble, bool is_error, std::uint32_t status = kDeviceOk);

  void probe(hal::TimeNs now_ns, CanOutbox& outbox);
  void settle(hal::TimeNs now_ns, CanOutbox& outbox);
  void switch_power(bool power_off, hal::TimeNs now_ns);
  void send_of_phase(hal::TimeNs now_ns, CanOutbox& outbox);
  void poll(hal::TimeNs now_ns, CanOutbox& outbox);
  bool poll_torque(hal::TimeNs now_ns, CanOutbox& outbox);
  bool is_time_to_send(double period_s, hal::TimeNs now_ns);
  [[nodiscard]] bool was_sent_before(hal::TimeNs time_ns) const;
  void send_torque(float torque_Nm, CanOutbox& outbox) const;
  void send_state(odrive::AxisState state, CanOutbox& outbox) const;

  ODriveConfig config_;
  EncoderCheck encoder_;
  AxisSample sample_;
  FaultLatch faults_;

  Continuity known_;
  Session session_;
  Stage stage_;
  Heard heard_;
  Polls polls_;
};

static_assert(CanDrive<ODriveCan>);

}  // namespace tactus::drivers
