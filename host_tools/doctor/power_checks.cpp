#include <fmt/format.h>

#include <string>

#include "host_tools/doctor/checks.h"

namespace tactus::host {

namespace {

constexpr const char* kSensors = "/sys/class/hwmon/";

}  // namespace

void check_power(Machine& machine, Findings& findings) {
  for (const std::string& sensor : machine.names(kSensors)) {
    const std::string folder = kSensors + sensor;
    if (machine.text(folder + "/name") != "rpi_volt") {
      continue;
    }
    if (machine.text(folder + "/in0_lcrit_alarm").value_or("0") == "0") {
      findings.push_back(well("power supply", "no low voltage since the last look"));
    } else {
      findings.push_back({"power supply", FindingState::mend,
                          "low voltage: the board slows its processors down, and USB may fail",
                          "sudo dmesg | grep -i voltage   # when; then take the supply that the "
                          "board's maker names, and feed motors from another one"});
    }
  }
}

}  // namespace tactus::host
