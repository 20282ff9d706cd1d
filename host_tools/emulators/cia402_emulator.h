// A CANopen drive with the profile CiA 402, as it appears on the bus. Tests and `tactus emulate
// cia402` run it.
//
// It fakes boot-up, NMT, heartbeats in both directions, emergencies, an SDO server for expedited
// transfers of the objects that a torque mode needs, PDOs as the master maps and types them (cyclic
// at SYNC, or on receipt), the profile's state machine, torque limits, and the loss of torque when
// the master's heartbeat stops, as objects 6007 and 1029 define it. A gap of kPowerLoss_ns between
// runs counts as a loss of power: the drive boots without a fault and counts from where its encoder
// starts. It does not fake segmented transfers, node guarding, remote requests, modes other than
// cyclic synchronous torque, and the time that a real drive takes to change its state.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "host_tools/emulators/can_emulator.h"
#include "host_tools/emulators/cia402_objects.h"
#include "host_tools/emulators/emulated_encoder.h"

namespace tactus::host {

// How the drive is made and set up.
struct Cia402EmulatorConfig {
  // The node's number, 1 to 127.
  std::uint8_t node = 1;
  EmulatedEncoder encoder = EmulatedEncoder::incremental;
  // Counts of 6064 in one turn of the shaft.
  double counts_per_turn = 4096.0;
  // The value of 6064 where the encoder reads 0.
  std::int64_t first_count = 0;
  // The torque that the motor really makes at 1000 thousandths.
  double rated_torque_Nm = 1.0;
  // The value of 6076, in the drive's own unit.
  std::uint32_t rated_torque = 1000;
  // The value of 60B2 that the drive has saved.
  std::int16_t torque_offset = 0;
  // The time from power-up or reset to the boot-up message.
  hal::TimeNs boot_time_ns = 20'000'000;
  // How the drive reacts to the silence of its host. Without a watchdog it accepts object 1016 and
  // ignores it; with `watchdog_lag_ns` it reacts that much later than it should.
  bool has_watchdog = true;
  hal::TimeNs watchdog_lag_ns = 0;
  // The fixed value of 1029:01: 0 leaves `operational`, 1 does nothing, 2 stops. If not given it is
  // 0 and can be written.
  std::optional<std::uint8_t> error_behaviour;
  // True for a drive that keeps its last torque when it is no longer `operational`.
  bool keeps_power_unheard = false;
  // True for a drive that stays in `operation enabled` when its motor's supply is gone.
  bool stays_enabled_unsupplied = false;
};

// One drive. The setters play events that no bus message causes.
class Cia402Emulator final : public CanEmulator {
 public:
  Cia402Emulator(hal::CanBus& bus, std::uint32_t seed, const Cia402EmulatorConfig& config);

  // Switches the motor's supply; the supply of the drive's electronics belongs to the faults.
  // Without it the drive does not leave `switch on disabled`.
  void set_motor_power(bool on) { stage_.has_supply = on; }
  // Acts like a safe torque off that closes again at once and is not reported.
  void drop_power() { stage_.state = Power::switch_on_disabled; }
  // Lets the encoder slip by that many counts at once.
  void slip(std::int64_t counts) { encoder_.first_count += counts; }
  // Raises a fault of the drive: its code appears in 603F, and in an emergency message if `tells`.
  void raise_fault(hal::TimeNs now_ns, std::uint16_t code, bool tells = true);
  // Sets or removes an object, as another make of drive would have it. For tests.
  void set_object(std::uint16_t index, std::uint8_t sub, std::uint32_t value) {
    objects_.set(index, sub, value);
  }
  void remove_object(std::uint16_t index, std::uint8_t sub) { objects_.remove(index, sub); }

  // Returns the statusword that the drive would send now.
  [[nodiscard]] std::uint16_t statusword() const;

 private:
  // The communication states of CiA 301; `booting` ends with the boot-up message.
  enum class Nmt : std::uint8_t { booting, pre_operational, operational, stopped };
  // The states of CiA 402. Faults react at once: there is no state between the fault and its
  // reaction.
  enum class Power : std::uint8_t {
    switch_on_disabled,
    ready_to_switch_on,
    switched_on,
    operation_enabled,
    quick_stop,
    fault,
  };
  // The last frame of a receive PDO; `waits` is true until the SYNC at which it takes effect.
  struct ReceivedPdo {
    hal::CanFrame frame;
    bool waits = false;
  };
  // The PDOs between two SYNCs, each by its number (0 to 3).
  struct Pdos {
    std::array<ReceivedPdo, 4> received;
    // For each transmit PDO the SYNCs since it was last sent.
    std::array<std::uint32_t, 4> syncs{};
  };
  // The node in the network of CiA 301.
  struct Network {
    Nmt state = Nmt::booting;
    // When booting ends, and when the drive's last heartbeat was sent.
    hal::TimeNs boots_ns = 0;
    hal::TimeNs beat_ns = 0;
  };
  // The power stage by the state machine of CiA 402.
  struct PowerStage {
    Power state = Power::switch_on_disabled;
    // True while the motor has its supply.
    bool has_supply = true;
    // True while the cause of a fault lasts: a fault reset has no effect.
    bool fault_persists = false;
    // The last controlword, to see the rising edge of the fault reset.
    std::uint16_t controlword = 0;
  };
  // The position sensor.
  struct Encoder {
    // The position in counts at angle 0.
    std::int64_t first_count = 0;
    // Turns of the shaft that it did not know of when it got its power.
    double forgotten_turns = 0.0;
  };
  using Key = Cia402Objects::Key;

  void take(hal::TimeNs now_ns, const hal::CanFrame& frame) override;
  void advance(const DriveRun& run) override;

  // Starts as after power-up: forgets faults, mode and commands, and whole turns as the encoder of
  // the configuration does.
  void get_power(hal::TimeNs now_ns);
  // Restores the communication objects and boots anew; NMT's "reset communication".
  void reset(hal::TimeNs now_ns);
  // Obeys a network command: start, stop, pre-operational, or a reset.
  void take_nmt(hal::TimeNs now_ns, const hal::CanFrame& frame);
  // Becomes pre-operational. A drive without fault also takes its torque away, unless
  // `keeps_power_unheard`.
  void leave_operational();
  void take_sync(hal::TimeNs now_ns);
  // Answers a request to read or write an object.
  void take_sdo(hal::TimeNs now_ns, const hal::CanFrame& frame);
  // Sends an object's value, or the abort code if there is no such object.
  void answer_read(hal::TimeNs now_ns, Key key);
  // Writes an object and confirms it, or sends the abort code.
  void answer_write(hal::TimeNs now_ns, const hal::CanFrame& frame, Key key);
  // Writes an object and does what the write causes. Returns 0, or the abort code if the write is
  // not permitted; nothing is changed then.
  std::uint32_t write_object(Key key, std::uint32_t value, std::uint32_t size);
  // Sends the reply that ends a transfer with `code`.
  void abort_sdo(hal::TimeNs now_ns, Key key, std::uint32_t code);

  // Takes a frame of the receive PDO with this number (0 to 3): keeps it for the SYNC or applies
  // it.
  void take_pdo(hal::TimeNs now_ns, std::size_t pdo, const hal::CanFrame& frame);
  // Writes the mapped objects in their order. A frame too short for them causes an emergency
  // message; the objects before the first that is missing are written.
  void apply_pdo(hal::TimeNs now_ns, std::size_t pdo, const hal::CanFrame& frame);
  // Sends the mapped objects' values of a transmit PDO (0 to 3).
  void send_pdo(hal::TimeNs now_ns, std::size_t pdo);

  // Sets position, speed, torque and statusword in the object dictionary from the shaft and the
  // state.
  void refresh_measured();
  // Makes the transition that a controlword demands.
  void step_power(std::uint16_t controlword);
  // Reacts to a master whose heartbeat has ceased. The watch begins with its first heartbeat.
  void watch_master(hal::TimeNs now_ns);
  // Reacts to the loss of the master as the objects 6007 and 1029 say.
  void abort_connection(hal::TimeNs now_ns);
  // Sends the drive's own heartbeat when it is due.
  void beat(hal::TimeNs now_ns);
  // Sends an emergency message with the error code and the error register.
  void send_emergency(hal::TimeNs now_ns, std::uint16_t code);
  // Returns true if the missing motor supply switches the drive off.
  [[nodiscard]] bool lacks_supply() const;
  // Returns the torque on the shaft in thousandths of the rated torque; 0 while the drive makes
  // none.
  [[nodiscard]] double torque_units() const;
  // Returns true if the target torque lies beyond the limits.
  [[nodiscard]] bool is_limited() const;

  Cia402EmulatorConfig config_;
  Cia402Objects objects_;
  Encoder encoder_;
  Pdos pdos_;
  Network network_;
  PowerStage stage_;
  // When the master's last heartbeat came; empty while it is not watched.
  std::optional<hal::TimeNs> heard_master_ns_;
};

}  // namespace tactus::host
