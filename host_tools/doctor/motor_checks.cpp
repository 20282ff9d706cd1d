// Tells for each motor of the device what stops it when the host fails. It cannot test a circuit,
// so a line outside of the drive is advice to try it.
#include <fmt/format.h>

#include "host_tools/doctor/checks.h"

namespace tactus::host {

namespace {

// SIGSTOP freezes the loop without any of its clean-up, as a crash of the machine would.
constexpr const char* kTry =
    "sudo kill -STOP $(pidof tactusd)   # while it pushes: the motor must let go";
constexpr const char* kAcceptedRemedy =
    "remove unproven_watchdog once something stops it; until then keep its supply within reach";

// Judges a motor whose drive has a watchdog of its own.
Finding judge_drive(const std::string& check, const MotorNeed& motor) {
  const std::string time = fmt::format("its drive's watchdog of {:.0f} ms", 1e3 * motor.watchdog_s);
  if (motor.is_accepted) {
    return {check, FindingState::advice,
            time + " may stop it, but unproven_watchdog = true starts without proof",
            "remove unproven_watchdog = true: the bring-up then proves the watchdog"};
  }
  if (!motor.advice.what.empty()) {
    return {check, FindingState::advice,
            fmt::format("{} stops it, proven at each bring-up; {}", time, motor.advice.what),
            std::string(motor.advice.remedy)};
  }
  return well(check, time + " stops it, proven at each bring-up");
}

Finding judge(const MotorNeed& motor) {
  const std::string check = "motor " + motor.axis;
  switch (motor.stop) {
    case firmware::MotorStop::drive_watchdog:
      return judge_drive(check, motor);
    case firmware::MotorStop::heartbeat_line:
      return {check, FindingState::advice,
              "a circuit on its heartbeat line stops it, if it is wired: the program cannot see it",
              kTry};
    case firmware::MotorStop::watchdog_line:
      return {check, FindingState::advice,
              "a circuit on the device's watchdog_line stops it, if it is wired: the program "
              "cannot see it",
              kTry};
    case firmware::MotorStop::nothing:
      break;
  }
  return {check, FindingState::advice,
          "NOTHING stops it when the host dies; unproven_watchdog = true accepts that",
          kAcceptedRemedy};
}

}  // namespace

void check_motors(Machine& /*machine*/, const Needs& needs, Findings& findings) {
  for (const MotorNeed& motor : needs.motors) {
    findings.push_back(judge(motor));
  }
}

}  // namespace tactus::host
