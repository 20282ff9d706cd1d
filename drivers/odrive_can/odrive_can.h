// An ODrive axis, firmware 0.5.x or 0.6.x, in torque mode over CANSimple.
//
// Bring-up: wait for a heartbeat; ask for the version, which only 0.6 answers; go idle, clear
// errors, set torque mode and limits; ask for closed loop and believe it after two heartbeats
// 150 ms apart. A torque goes out every tick from then on, zero until the axis is up, and feeds the
// drive's watchdog.
// From a fault on: torque zero every tick and the idle state asked for again and again, until
// clear_faults.
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
// With the last five the sample keeps the last good position.
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
    up,
    failed,
  };

  void enter(Phase phase, hal::TimeNs now_ns);
  void fail(std::uint32_t status, const Trouble& trouble);
  void watch_deadlines(hal::TimeNs now_ns);
  void watch_samples(hal::TimeNs now_ns);
  void watch_bring_up(hal::TimeNs now_ns);

  void take_heartbeat(const odrive::Heartbeat& heartbeat, hal::TimeNs time_ns);
  void take_while_arming(const odrive::Heartbeat& heartbeat, hal::TimeNs time_ns);
  void take_estimates(const odrive::Estimates& estimates, hal::TimeNs time_ns);
  void take_reply(const hal::CanFrame& frame, hal::TimeNs time_ns);
  void take_reply_0_5(const hal::CanFrame& frame);
  void take_reply_0_6(const hal::CanFrame& frame);
  void fail_by_error(std::uint32_t error);
  void explain(const Trouble& trouble, bool is_error);

  void probe(hal::TimeNs now_ns, CanOutbox& outbox);
  void settle(hal::TimeNs now_ns, CanOutbox& outbox);
  void poll(hal::TimeNs now_ns, CanOutbox& outbox);
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
  hal::TimeNs closed_since_ns_ = 0;
  std::uint32_t last_error_ = 0;        // in the newest heartbeat
  std::uint32_t refused_in_a_row_ = 0;  // heartbeats
  std::size_t next_poll_ = 0;
  bool is_closed_ = false;          // while arming, by the newest heartbeat
  bool has_sent_ = false;           // in this phase
  bool wants_explanation_ = false;  // the fault's cause is to be asked for
};

static_assert(CanDrive<ODriveCan>);

}  // namespace tactus::drivers
