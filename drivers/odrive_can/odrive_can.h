// An ODrive axis, firmware 0.5.x or 0.6.x, in torque mode over CANSimple.
//
// Bring-up: wait for a heartbeat; ask for the version, which only 0.6 answers; go idle, clear
// errors, set torque mode and limits; ask for closed loop. In closed loop at zero torque nothing is
// sent until the drive's watchdog has stopped the motor and the drive has said so; then errors are
// cleared and closed loop is asked for again, and believed after two heartbeats 150 ms apart. A
// drive that goes on without commands is refused. A torque goes out every tick but then, zero until
// the axis is up, and feeds the drive's watchdog.
// `power_off` makes the axis go idle; without it the axis comes up again.
// From a fault on: torque zero every tick and the idle state asked for again and again, until
// clear_faults. A failed axis goes on being watched, for its position may be lost later.
//
// The position is followed from the first time that the axis was up, also through faults and
// bring-ups, without a gap longer than estimate_lost_s: a drive that restarts counts from another
// zero.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "drivers/axis.h"
#include "drivers/can_drive.h"
#include "drivers/encoder_check.h"
#include "drivers/odrive_can/odrive_config.h"
#include "drivers/odrive_can/odrive_protocol.h"
#include "hal/can_frame.h"
#include "hal/clock.h"

namespace tactus::drivers {

// What the drive told besides; zero where it did not.
struct ODriveReadings {
  odrive::BusPower bus;
  odrive::Current current;
  odrive::Temperature temperature;
  std::uint32_t malformed = 0;  // frames of this node with a wrong length
};

// A CanDrive. Status bits:
//   kDeviceNotReady       from start until closed loop
//   kDeviceStale          no estimate for estimate_stale_s; not latched
//   kDeviceLost           no heartbeat or no estimate in time
//   kDeviceDriveFault     an error bit, a refused bring-up, or closed loop left
//   kDeviceEmergencyStop  with it, if that is what the drive says
//   kDeviceTooHot         likewise
//   kDeviceEncoderFault   a position that is not a number or that no shaft can have reached
//   kDeviceReferenceLost  with either of lost and encoder fault; an error that tells of supply or
//                         encoder; an error that went or closed loop that was left without a cause,
//                         as a restart does
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
  [[nodiscard]] Trouble trouble() const { return trouble_; }
  // Without effect on an axis that is well.
  void clear_faults(hal::TimeNs now_ns);
  void shutdown(CanOutbox& outbox);

  [[nodiscard]] odrive::Generation generation() const { return generation_; }
  [[nodiscard]] const ODriveReadings& readings() const { return readings_; }

 private:
  enum class Phase : std::uint8_t {
    off,
    listening,  // for the first heartbeat
    probing,    // for the version
    settling,   // idle, errors cleared, torque mode
    arming,     // closed loop asked for
    proving,    // silent in closed loop, until the watchdog trips
    up,
    resting,  // idle, since the power is to be off
    failed,
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
  Phase phase_ = Phase::off;
  odrive::Generation generation_ = odrive::Generation::unknown;
  AxisSample sample_;
  Trouble trouble_;
  ODriveReadings readings_;

  hal::TimeNs phase_since_ns_ = 0;
  hal::TimeNs heartbeat_ns_ = 0;
  hal::TimeNs estimate_ns_ = 0;
  hal::TimeNs first_sent_ns_ = 0;  // what the phase has to say
  hal::TimeNs last_sent_ns_ = 0;
  hal::TimeNs polled_ns_ = 0;
  hal::TimeNs torque_ns_ = 0;         // when the drive last told its torque
  hal::TimeNs torque_polled_ns_ = 0;  // when it was last asked for
  hal::TimeNs closed_since_ns_ = 0;
  std::uint32_t last_error_ = 0;        // in the newest heartbeat
  std::uint32_t refused_in_a_row_ = 0;  // heartbeats
  std::uint32_t proofs_ = 0;            // begun since the watchdog may be another
  std::size_t next_poll_ = 0;
  bool is_closed_ = false;          // while arming, by the newest heartbeat
  bool has_sent_ = false;           // in this phase
  bool wants_explanation_ = false;  // the fault's cause is to be asked for
  bool is_followed_ = false;        // the position, since the axis was up
  bool is_proven_ = false;          // the watchdog, and the drive has not restarted since
};

static_assert(CanDrive<ODriveCan>);

}  // namespace tactus::drivers
