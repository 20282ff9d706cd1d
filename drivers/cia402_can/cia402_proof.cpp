// The part of Cia402Can that proves that the drive takes the torque away when the host falls
// silent.
//
// The drive has power and zero torque. It receives the SYNC, which the other drives need, and
// nothing else. It must leave every state that may have torque, and report that the reason is the
// silence: in an emergency message, or in 603F:00. A drive that stops for another reason, such as
// an emergency stop, proves nothing.
#include <cstdint>

#include "drivers/cia402_can/cia402_can.h"
#include "drivers/cia402_can/error_codes.h"
#include "drivers/common/seconds.h"

namespace tactus::drivers {

namespace {

constexpr canopen::ObjectAddress kStatuswordObject{0x6041, 0};

// Drives check their watchdogs every few milliseconds, and then release the motor.
constexpr double kDriveLooks_s = 0.02;
// The ticks in which the drive's states and reasons are asked for and answered.
constexpr double kTicksToTell = 8.0;
// A drive that leaves operational sends no more PDOs. It is asked after so many SYNCs.
constexpr std::uint32_t kSilentSyncs = 3;

constexpr Trouble kNoWatchdog{
    "drive's watchdog does not take the torque away when the host falls silent (1016:01)",
    "check 1016, 1029 and 6007 in its manual, let no other program send the host's heartbeat, "
    "then reset; unproven_watchdog = true does without",
    0};

}  // namespace

// The drive must first release the motor, and then the reason must be known. An error code that is
// read counts only in a fault; otherwise it may belong to an earlier one.
void Cia402Can::prove(CanOutbox& outbox) {
  if (!stage_.has_let_go) {
    if (tick_.unanswered_syncs >= kSilentSyncs) {
      if (const auto statusword = objects_.read(kStatuswordObject, tick_.now_ns, outbox)) {
        take_power_in_proof(static_cast<std::uint16_t>(*statusword & 0xFFFFU));
      }
    }
  } else if (stage_.was_told_why) {
    known_.is_proven = true;
    start_again();
  } else if (cia402::power_state(reports_.state.statusword) == cia402::PowerState::fault) {
    if (const auto code = objects_.read(cia402::kErrorCodeObject, tick_.now_ns, outbox)) {
      judge_reason(static_cast<std::uint16_t>(*code & 0xFFFFU));
    }
  }
}

void Cia402Can::take_power_in_proof(std::uint16_t statusword) {
  reports_.state.statusword = statusword;
  const cia402::PowerState power = cia402::power_state(statusword);
  if (stage_.has_let_go || cia402::may_have_torque(power)) {
    return;
  }
  objects_.reset();
  const bool has_supply = (statusword & cia402::kVoltageEnabled) != 0;
  if (power != cia402::PowerState::fault && session_.power.had_supply() && !has_supply) {
    latch_missing_supply();
  } else {
    stage_.has_let_go = true;
  }
}

void Cia402Can::judge_reason(std::uint16_t code) {
  const std::uint16_t told = reports_.emergency_code != 0 ? reports_.emergency_code : code;
  constexpr std::uint16_t kMakersOwn = 0xF000;
  if (cia402::is_host_silent(code)) {
    stage_.was_told_why = true;
  } else if ((told & kMakersOwn) == kMakersOwn) {
    latch(
        kDeviceDriveFault,
        {"drive stopped with an error code of its maker's own while its watchdog was to be proven",
         "look the code up in its manual and reset; if it means the host's heartbeat, "
         "unproven_watchdog = true does without the proof",
         told});
  } else if (told != 0) {
    latch_error(told);
  }
}

void Cia402Can::watch_proof() {
  const double limit_s =
      1e-3 * config_.watchdog_ms + kDriveLooks_s + kTicksToTell * config_.period_s;
  if (!has_passed_since(stage_.begun_ns, limit_s)) {
    return;
  }
  if (stage_.has_let_go && reports_.emergency_code != 0) {
    judge_reason(reports_.emergency_code);
  } else if (stage_.has_let_go) {
    latch(kDeviceDriveFault,
          {"drive let the motor go while its watchdog was to be proven, and does not say why",
           "check motor power and safe torque off, then reset; unproven_watchdog = true does "
           "without the proof",
           reports_.state.statusword});
  } else if (tick_.unanswered_syncs >= kSilentSyncs && objects_.is_asking()) {
    latch(kDeviceLost, {"drive does not answer while its watchdog is proven",
                        "check its power and the cable, then reset", 0});
  } else {
    latch(kDeviceDriveFault, kNoWatchdog);
  }
  objects_.reset();
}

// Starts the drive again, which may have left operational and is in a fault.
void Cia402Can::start_again() {
  reports_.running = {};
  objects_.restart();
  session_.power.close();
  enter(Phase::starting);
}

}  // namespace tactus::drivers
