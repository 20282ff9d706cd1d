// A CANopen drive with the CiA 402 profile, from the other side of the bus.
//
// Fakes: boot-up, NMT, heartbeats either way, emergencies, an SDO server for expedited transfers
// over the objects that a torque mode needs, PDOs as mapped and typed by the master (cyclic at
// SYNC, or on receipt), the profile's state machine with its illegal transitions refused, torque
// limits, and the end of its power when the master's heartbeat stops, as objects 6007 and 1029 have
// it. A gap of kPowerLoss_ns between runs counts as a loss of power: it boots again, in no fault,
// and counts from where its encoder starts.
// Does not fake: segmented transfers, node guarding, remote requests, other modes than cyclic
// synchronous torque, the time that a real drive takes to change state.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>

#include "host_tools/emulators/can_emulator.h"

namespace tactus::host {

struct Cia402EmulatorConfig {
  std::uint8_t node = 1;
  EmulatedEncoder encoder = EmulatedEncoder::incremental;
  double counts_per_turn = 4096.0;
  std::int64_t first_count = 0;       // 6064:00 where the encoder says 0
  double rated_torque_Nm = 1.0;       // what the motor does
  std::uint32_t rated_torque = 1000;  // what 6076:00 says, in the drive's own unit
  std::int16_t torque_offset = 0;     // 60B2:00 as the drive has it saved
  hal::TimeNs boot_time_ns = 20'000'000;
  // Its reaction to the silence of a host. A drive without a watchdog accepts object 1016 and
  // ignores it; a slow one lets `watchdog_lag_ns` more time pass.
  bool has_watchdog = true;
  hal::TimeNs watchdog_lag_ns = 0;
  // 1029:01 as the drive has it for good; nothing: 0, and it can be written. 0 leaves operational,
  // 1 does nothing, 2 stops.
  std::optional<std::uint8_t> error_behaviour;
  // A drive that goes on with its last torque when it is no more operational.
  bool keeps_power_unheard = false;
  // A drive that stays in 'operation enabled' when its motor's supply is gone.
  bool stays_enabled_unsupplied = false;
};

class Cia402Emulator final : public CanEmulator {
 public:
  static constexpr hal::TimeNs kPowerLoss_ns = 20'000'000;

  Cia402Emulator(hal::CanBus& bus, std::uint32_t seed, const Cia402EmulatorConfig& config);

  // The motor's supply; the drive's own is a matter of the fault port. Without it the drive does
  // not leave 'switch on disabled'.
  void set_motor_power(bool on) { motor_power_ = on; }
  // Acts like a safe torque off that closes again at once and is not reported.
  void drop_power() { power_ = Power::switch_on_disabled; }
  // Lets its encoder slip by that many counts at once.
  void slip(std::int64_t counts) { first_count_ += counts; }
  // A fault of its own, with its code in 603F and, if it tells, an emergency message.
  void raise_fault(hal::TimeNs now_ns, std::uint16_t code, bool tells = true);
  // Sets an object as a drive of another make would have it, or removes it. For tests.
  void set_object(std::uint16_t index, std::uint8_t sub, std::uint32_t value);
  void remove_object(std::uint16_t index, std::uint8_t sub);

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
  struct Object {
    std::uint32_t value = 0;
    std::uint8_t size = 0;  // bytes
    bool writable = false;
  };
  struct ReceivedPdo {
    hal::CanFrame frame;
    bool waits = false;  // for SYNC
  };
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
  double forgotten_turns_ = 0.0;  // of the shaft, by the encoder, when it got its power
  std::map<Key, Object> objects_;
  std::array<ReceivedPdo, 4> received_;
  std::array<std::uint32_t, 4> syncs_{};  // since the last sending, for each transmit PDO
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
