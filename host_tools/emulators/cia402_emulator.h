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
#include <map>
#include <optional>
#include <utility>

#include "host_tools/emulators/can_emulator.h"

namespace tactus::host {

// How the drive is made and set up.
struct Cia402EmulatorConfig {
  std::uint8_t node = 1;
  EmulatedEncoder encoder = EmulatedEncoder::incremental;
  double counts_per_turn = 4096.0;
  // The value of 6064 where the encoder reads 0.
  std::int64_t first_count = 0;
  // The torque that the motor really makes at 1000 thousandths.
  double rated_torque_Nm = 1.0;
  // The value of 6076, in the drive's own unit.
  std::uint32_t rated_torque = 1000;
  // The value of 60B2 that the drive has saved.
  std::int16_t torque_offset = 0;
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
  static constexpr hal::TimeNs kPowerLoss_ns = 20'000'000;

  Cia402Emulator(hal::CanBus& bus, std::uint32_t seed, const Cia402EmulatorConfig& config);

  // Switches the motor's supply; the supply of the drive's electronics belongs to the faults.
  // Without it the drive does not leave `switch on disabled`.
  void set_motor_power(bool on) { motor_power_ = on; }
  // Acts like a safe torque off that closes again at once and is not reported.
  void drop_power() { power_ = Power::switch_on_disabled; }
  // Lets the encoder slip by that many counts at once.
  void slip(std::int64_t counts) { first_count_ += counts; }
  // Raises a fault of the drive: its code appears in 603F, and in an emergency message if `tells`.
  void raise_fault(hal::TimeNs now_ns, std::uint16_t code, bool tells = true);
  // Sets or removes an object, as another make of drive would have it. For tests.
  void set_object(std::uint16_t index, std::uint8_t sub, std::uint32_t value);
  void remove_object(std::uint16_t index, std::uint8_t sub);

  // Returns the statusword that the drive would send now.
  [[nodiscard]] std::uint16_t statusword() const;

 private:
  enum class Nmt : std::uint8_t { booting, pre_operational, operational, stopped };
  enum class Power : std::uint8_t {
    switch_on_disabled,
    ready_to_switch_on,
    switched_on,
    operation_enabled,
    quick_stop,
    fault,
  };
  // An entry of the object dictionary; `size` in bytes.
  struct Object {
    std::uint32_t value = 0;
    std::uint8_t size = 0;  // bytes
    bool writable = false;
  };
  // The last frame of a receive PDO; `waits` is true until the SYNC at which it takes effect.
  struct ReceivedPdo {
    hal::CanFrame frame;
    bool waits = false;  // for SYNC
  };
  // Index and subindex.
  using Key = std::pair<std::uint16_t, std::uint8_t>;

  void take(hal::TimeNs now_ns, const hal::CanFrame& frame) override;
  void advance(hal::TimeNs now_ns, bool erroring) override;

  void get_power(hal::TimeNs now_ns);
  void reset(hal::TimeNs now_ns);
  void define_communication();
  void define_profile();
  void take_nmt(hal::TimeNs now_ns, const hal::CanFrame& frame);
  void leave_operational();
  void take_sync(hal::TimeNs now_ns);
  void take_sdo(hal::TimeNs now_ns, const hal::CanFrame& frame);
  void answer_read(hal::TimeNs now_ns, Key key);
  void answer_write(hal::TimeNs now_ns, const hal::CanFrame& frame, Key key);
  std::uint32_t write_object(Key key, std::uint32_t value, std::uint32_t size);
  std::uint32_t why_not(Key key, std::uint32_t value, std::uint32_t size) const;
  void abort_sdo(hal::TimeNs now_ns, Key key, std::uint32_t code);

  void take_pdo(hal::TimeNs now_ns, std::size_t pdo, const hal::CanFrame& frame);
  void apply_pdo(hal::TimeNs now_ns, std::size_t pdo, const hal::CanFrame& frame);
  void send_pdo(hal::TimeNs now_ns, std::size_t pdo);

  void refresh_measured();
  void step_power(std::uint16_t controlword);
  void watch_master(hal::TimeNs now_ns);
  void abort_connection(hal::TimeNs now_ns);
  void beat(hal::TimeNs now_ns);
  void send_emergency(hal::TimeNs now_ns, std::uint16_t code);
  [[nodiscard]] std::uint32_t object(std::uint16_t index, std::uint8_t sub) const;
  [[nodiscard]] bool lacks_supply() const;
  [[nodiscard]] double torque_units() const;
  [[nodiscard]] bool is_limited() const;

  Cia402EmulatorConfig config_;
  std::int64_t first_count_;
  // Turns of the shaft that the encoder did not know of when it got its power.
  double forgotten_turns_ = 0.0;
  std::map<Key, Object> objects_;
  std::array<ReceivedPdo, 4> received_;
  // For each transmit PDO the SYNCs since it was last sent.
  std::array<std::uint32_t, 4> syncs_{};
  Nmt nmt_ = Nmt::booting;
  Power power_ = Power::switch_on_disabled;
  bool motor_power_ = true;
  bool fault_persists_ = false;
  bool has_run_ = false;
  std::uint16_t controlword_ = 0;
  hal::TimeNs boots_ns_ = 0;
  hal::TimeNs ran_ns_ = 0;
  hal::TimeNs beat_ns_ = 0;
  std::optional<hal::TimeNs> heard_master_ns_;
};

}  // namespace tactus::host
