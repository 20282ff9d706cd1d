// A CANopen drive with the CiA 402 profile in cyclic synchronous torque mode.
//
// The frames are those of canopen.h, sdo.h and drive_profile.h.
//
// The SYNC opens the request of a tick, ahead of everything else. The drives take their position at
// the SYNC and send it right after, so the tick computes with the freshest sample that the bus
// allows. The torques of the last tick act at the same instant in every axis, without the jitter of
// the computation. A SYNC behind the commands would make the torque act earlier and the sample
// older by the same time: the delay around the loop is one period either way. `torque_on_receipt`
// makes it shorter, for drives that support it.
//
// The bring-up has these steps: reset of the drive's communication, boot-up, the set-up of
// bring_up.h, NMT start, torque mode, reset of a fault of the drive, 'ready to switch on'. Then
// sample().status is kDeviceOk, and the power follows the command. Up to a second may pass between
// `enable` and torque.
//
// The bring-up proves the drive's watchdog before the first 'ready'. With power on and at zero
// torque the drive is sent nothing but the SYNC, until it reports that it released the motor
// because the host is silent. Then it is started again. The proof stays valid while the position is
// followed: a bring-up after a fault that leaves the position alone is without a proof. While
// `power_off` is set the proof waits.
//
// A sample that did not come in time has an old time but not kDeviceStale, because the board does
// not wait for a stale axis. The drive answers the next SYNC again.
//
// These faults are latched until clear_faults:
//   kDeviceDriveFault    the drive reports a fault (EMCY, statusword); leaves torque mode, power or
//                        operational by itself; restarts; does not switch its power on; refuses the
//                        set-up; or does not stop when the host is silent
//   kDeviceTooHot        beside it, if the drive reports over-temperature
//   kDeviceReferenceLost beside kDeviceLost and kDeviceEncoderFault, after a restart, and after
//                        errors of supply or encoder, also after another fault and in the
//                        bring-up after clear_faults, since the drive is still watched. 'Not
//                        ready to switch on' and leaving operational without an error count as a
//                        restart. A loss of the motor's supply alone keeps the reference
//   kDeviceEncoderFault  a position that the shaft cannot have reached; the sample keeps the
//                        last good one
//   kDeviceLost          no sample for lost_after_s, no heartbeat, no answer, or not up in time
// After a fault each tick sends torque zero and 'disable voltage'. The driver cannot detect samples
// that are late by a constant time from the very start.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "drivers/axis.h"
#include "drivers/can_drive.h"
#include "drivers/cia402_can/canopen.h"
#include "drivers/cia402_can/cia402_config.h"
#include "drivers/cia402_can/drive_objects.h"
#include "drivers/cia402_can/drive_profile.h"
#include "drivers/cia402_can/drive_sample.h"
#include "drivers/cia402_can/power_request.h"
#include "drivers/common/continuity.h"
#include "drivers/common/fault_latch.h"
#include "drivers/common/repeat_timer.h"

namespace tactus::drivers {

// A CanDrive.
class Cia402Can {
 public:
  // The configuration has passed `check`.
  explicit Cia402Can(const Cia402Config& config);

  std::size_t filters(std::span<hal::CanFilter> filters) const;
  void start(hal::TimeNs now_ns);
  void take(const hal::CanReceived& received);
  void request(hal::TimeNs now_ns, CanOutbox& outbox);
  void command(hal::TimeNs now_ns, const AxisCommand& command, CanOutbox& outbox);
  [[nodiscard]] const AxisSample& sample() const { return sample_.sample(); }
  [[nodiscard]] Trouble trouble() const { return faults_.trouble(); }
  void clear_faults(hal::TimeNs now_ns);
  void shutdown(CanOutbox& outbox);

  [[nodiscard]] const Cia402Config& config() const { return config_; }
  // Returns the values that the drive reported, for the log. They are complete once the drive is
  // ready.
  [[nodiscard]] const cia402::DriveFacts& facts() const { return objects_.facts(); }

 private:
  enum class Phase : std::uint8_t {
    off,
    booting,        // until the drive reports its boot-up
    setting_up,     // bring_up.h
    starting,       // until the drive is operational and sends samples
    choosing_mode,  // until the drive reports torque mode
    clearing,       // until the drive has no fault and is ready to switch on
    powering,       // until the drive has power, at zero torque
    proving,        // only SYNC, until the drive's watchdog trips; then `starting` again
    ready,
  };

  // The phase and the progress in it. Each phase begins with a fresh one.
  struct Stage {
    Phase phase = Phase::off;
    hal::TimeNs begun_ns = 0;
    // The NMT command that the phase repeats.
    RepeatTimer nmt;
    // In the proof: the drive released the motor.
    bool has_let_go = false;
    // In the proof: the drive reported that the host is silent.
    bool was_told_why = false;
  };

  // One bring-up and the operation after it, until faults are cleared.
  struct Session {
    hal::TimeNs begun_ns = 0;
    cia402::PowerRequest power;
    // After a fault: power was taken away by an SDO.
    bool is_cut_off = false;
    // After a fault: the driver asks for the error code.
    bool reads_error_code = false;
  };

  // The tick and the samples that the drive sent for its SYNC.
  struct Tick {
    hal::TimeNs now_ns = 0;
    hal::TimeNs sync_ns = 0;
    // The command was sent, the next SYNC was not.
    bool is_over = false;
    // The number of SYNCs since the last sample.
    std::uint32_t unanswered_syncs = 0;
    // The last sample came after its tick.
    bool is_late = false;
  };

  // The newest reports of the drive about itself.
  struct Reports {
    cia402::DriveState state;
    // The error code of the last emergency message; 0: none.
    std::uint16_t emergency_code = 0;
    // The time of the last heartbeat.
    hal::TimeNs heartbeat_ns = 0;
    // The last heartbeat reported the state 'pre-operational'.
    bool is_pre_operational = false;
    // The reports that show that the drive runs. They count from its last start.
    struct Running {
      bool is_operational = false;
      bool has_state = false;
      bool in_torque_mode = false;
    } running;
  };

  void begin(hal::TimeNs now_ns);
  void enter(Phase phase);
  [[nodiscard]] bool is_live() const { return stage_.phase >= Phase::starting; }
  [[nodiscard]] bool has_passed_since(hal::TimeNs since_ns, double time_s) const;
  void latch(DeviceStatus bit, const Trouble& trouble);
  void lose_reference(DeviceStatus bit, const Trouble& trouble);
  void latch_error(std::uint16_t code);
  void watch_heartbeat();
  void update_status();

  void take_state(const cia402::DriveState& state);
  void take_sample();
  void take_motion(const cia402::DriveMotion& motion);
  void take_heartbeat(canopen::NmtState state);
  void take_emergency(const canopen::Emergency& emergency);
  void check_power();
  void latch_drive_fault();
  void latch_missing_supply();
  void leave_operational(canopen::NmtState state);

  void watch();
  void watch_bring_up();
  void watch_samples();
  [[nodiscard]] Trouble late_bring_up() const;

  void feed_watchdog(CanOutbox& outbox);
  void cut_power(CanOutbox& outbox);
  void boot(CanOutbox& outbox);
  void bring_up(const AxisCommand& command, CanOutbox& outbox);
  void clear_drive(const AxisCommand& command);
  void repeat_nmt(canopen::NmtCommand command, double every_s, CanOutbox& outbox);
  void run_set_up(CanOutbox& outbox);
  void choose_mode(CanOutbox& outbox);
  bool is_done(const cia402::DriveObjects::Progress& progress);
  void read_error_code(CanOutbox& outbox);

  [[nodiscard]] bool is_silent() const { return stage_.phase == Phase::proving && !faults_; }
  void prove(CanOutbox& outbox);
  void take_power_in_proof(std::uint16_t statusword);
  void judge_reason(std::uint16_t code);
  void watch_proof();
  void start_again();

  [[nodiscard]] cia402::TorqueCommand next_command(const AxisCommand& command);
  [[nodiscard]] cia402::TorqueCommand powered_command(const AxisCommand& command);
  [[nodiscard]] std::uint16_t clearing_controlword() const;
  [[nodiscard]] std::int16_t torque_units(double torque_Nm) const;

  Cia402Config config_;
  cia402::DriveObjects objects_;
  cia402::DriveSample sample_;
  FaultLatch faults_;

  Continuity known_;
  Session session_;
  Stage stage_;
  Tick tick_;
  Reports reports_;
  RepeatTimer host_heartbeat_;
};

static_assert(CanDrive<Cia402Can>);

}  // namespace tactus::drivers
