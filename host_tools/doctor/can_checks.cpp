#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "host_tools/doctor/can_link.h"
#include "host_tools/doctor/checks.h"
#include "host_tools/doctor/raspberry_pi.h"
#include "host_tools/install_command.h"

namespace tactus::host {

namespace {

// The kernel's constants as sysfs prints them: IFF_UP and CANFD_MTU.
constexpr std::uint64_t kUpFlag = 1;
constexpr const char* kFdMtu = "72";
// Bit/s; the frames of three axes at 1 kHz need it.
constexpr std::int64_t kUsualBitrate = 1'000'000;

// Returns true if the interface is switched on.
bool is_up(Machine& machine, const std::string& interface) {
  const std::string flags = machine.text(kNetworkFolder + interface + "/flags").value_or("0x0");
  return (std::strtoull(flags.c_str(), nullptr, 16) & kUpFlag) != 0;
}

// Returns the command that sets the interface up as the device needs it.
std::string bring_up(const CanNeed& need) {
  return fmt::format("sudo ip link set {0} down; sudo ip link set {0} up type can {1}",
                     need.interface, need.set_up);
}

// Returns for example "up, 1000 kbit/s, ERROR-ACTIVE, 42 % busy".
std::string in_words(const CanNeed& need, const CanLink& link) {
  std::string text = fmt::format("up, {:g} kbit/s", 1e-3 * static_cast<double>(link.bitrate));
  if (link.data_bitrate > 0) {
    text += fmt::format(", data {:g} kbit/s", 1e-3 * static_cast<double>(link.data_bitrate));
  }
  text += link.state.empty() ? "" : ", " + link.state;
  return need.load > 0.0 ? text + fmt::format(", {:.0f} % busy", 100.0 * need.load) : text;
}

// Returns true if the interface has other bit rates than the device's file says.
bool has_other_rate(const CanNeed& need, const CanLink& link) {
  return (need.bitrate > 0 && link.bitrate != need.bitrate) ||
         (need.data_bitrate > 0 && link.data_bitrate != need.data_bitrate);
}

// Judges the settings of an interface that is up.
Finding judge(const CanNeed& need, const CanLink& link, const std::string& mtu) {
  const std::string check = "CAN " + need.interface;
  if (need.fd && mtu != kFdMtu) {
    return {check, FindingState::mend, "up without CAN FD, which drives on it speak",
            bring_up(need)};
  }
  if (!link.told) {
    return {check, FindingState::not_looked, "up; without the program ip its bit rate is not known",
            install_command("iproute2")};
  }
  if (link.is_virtual) {
    return well(check, "up, virtual");
  }
  if (link.bitrate == 0) {
    return {check, FindingState::mend, "up without a bit rate", bring_up(need)};
  }
  if (!link.state.empty() && link.state != "ERROR-ACTIVE") {
    return {check, FindingState::mend,
            in_words(need, link) + ": check termination, wiring and the drives' bit rate",
            bring_up(need)};
  }
  if (has_other_rate(need, link)) {
    return {check, FindingState::mend, in_words(need, link) + "; the device's file says otherwise",
            bring_up(need)};
  }
  if (need.bitrate == 0 && link.bitrate < kUsualBitrate) {
    return {check, FindingState::advice,
            in_words(need, link) + "; three axes at 1 kHz need 1000 kbit/s", bring_up(need)};
  }
  return well(check, in_words(need, link));
}

// Judges an interface from the outside in: present, of type CAN, up, then its settings.
Finding look_and_judge(Machine& machine, const CanNeed& need) {
  const std::string check = "CAN " + need.interface;
  if (!machine.text(kNetworkFolder + need.interface + "/type")) {
    constexpr const char* kHat = "dtoverlay=mcp251xfd,spi0-0,oscillator=40000000,interrupt=25";
    return {
        check, FindingState::mend, "no such interface",
        is_raspberry_pi(machine)
            ? add_firmware_line(kHat) + "   # with the numbers of the hat's maker"
            : "ip -details link show type can   # those there are; plug the adapter in, or load "
              "its driver"};
  }
  if (!is_can(machine, need.interface)) {
    return {check, FindingState::mend, "is no CAN interface",
            "ip -details link show type can   # those there are"};
  }
  if (!is_up(machine, need.interface)) {
    return {check, FindingState::mend, "down", bring_up(need)};
  }
  return judge(need, can_link(machine, need.interface),
               machine.text(kNetworkFolder + need.interface + "/mtu").value_or(""));
}

}  // namespace

void check_can(Machine& machine, const Needs& needs, Findings& findings) {
  const std::vector<CanNeed> all = can_to_look_at(machine, needs);
  if (needs.anything && all.empty()) {
    findings.push_back(well("CAN", "no interface"));
  }
  for (const CanNeed& need : all) {
    findings.push_back(look_and_judge(machine, need));
  }
}

}  // namespace tactus::host
