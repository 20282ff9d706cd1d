#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "host_tools/doctor/checks.h"
#include "host_tools/install_command.h"

namespace tactus::host {

namespace {

constexpr const char* kNet = "/sys/class/net/";
// The kernel's constants as sysfs prints them: ARPHRD_CAN, IFF_UP and CANFD_MTU.
constexpr const char* kCanType = "280";
constexpr std::uint64_t kUpFlag = 1;
constexpr const char* kFdMtu = "72";
// Bit/s; the frames of three axes at 1 kHz need it.
constexpr std::int64_t kUsualBitrate = 1'000'000;

// A CAN interface as `ip` describes it.
struct CanLink {
  // True for vcan, which has no bit rate.
  bool is_virtual = false;
  // False if `ip` is missing or printed nothing that is understood.
  bool told = false;
  // Bit/s; 0 if not set. The data bit rate is that of CAN FD frames.
  std::int64_t bitrate = 0;
  std::int64_t data_bitrate = 0;
  // The error state of the CAN controller; "ERROR-ACTIVE" is the normal one.
  std::string state;
};

// Returns the bit rate of a group such as "bittiming", bit/s; 0 if it is not there.
std::int64_t bitrate_in(const nlohmann::json& data, const char* timing) {
  return data.contains(timing) && data[timing].is_object()
             ? data[timing].value("bitrate", std::int64_t{0})
             : 0;
}

// Reads the JSON of `ip`. Throws nlohmann::json::exception if a value has an unexpected type.
CanLink link_from(const std::string& text) {
  CanLink link;
  const auto json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_array() || json.empty() || !json[0].is_object()) {
    return link;
  }
  link.told = true;
  const nlohmann::json info = json[0].value("linkinfo", nlohmann::json::object());
  link.is_virtual = info.is_object() && info.value("info_kind", "") != "can";
  const nlohmann::json data =
      info.is_object() ? info.value("info_data", nlohmann::json::object()) : nlohmann::json();
  if (data.is_object()) {
    link.bitrate = bitrate_in(data, "bittiming");
    link.data_bitrate = bitrate_in(data, "data_bittiming");
    link.state = data.value("state", "");
  }
  return link;
}

// Asks `ip` about an interface.
CanLink look_at(Machine& machine, const std::string& interface) {
  try {
    return link_from(machine.ip_link(interface).value_or(""));
  } catch (const nlohmann::json::exception&) {
    return {};  // an `ip` that writes other types than the one that is known
  }
}

// Returns true if the interface is switched on.
bool is_up(Machine& machine, const std::string& interface) {
  const std::string flags = machine.text(kNet + interface + "/flags").value_or("0x0");
  return (std::strtoull(flags.c_str(), nullptr, 16) & kUpFlag) != 0;
}

// Returns the command that sets the interface up as the device needs it.
std::string bring_up(const CanNeed& need) {
  return fmt::format("sudo ip link set {0} down; sudo ip link set {0} up type can {1}",
                     need.interface, need.set_up);
}

// Returns for example "up, 1000 kbit/s, ERROR-ACTIVE".
std::string in_words(const CanLink& link) {
  std::string text = fmt::format("up, {:g} kbit/s", static_cast<double>(link.bitrate) * 1e-3);
  if (link.data_bitrate > 0) {
    text += fmt::format(", data {:g} kbit/s", static_cast<double>(link.data_bitrate) * 1e-3);
  }
  return text + (link.state.empty() ? "" : ", " + link.state);
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
            in_words(link) + ": check termination, wiring and the drives' bit rate",
            bring_up(need)};
  }
  if (link.bitrate < kUsualBitrate) {
    return {check, FindingState::advice, in_words(link) + "; three axes at 1 kHz need 1000 kbit/s",
            bring_up(need)};
  }
  return well(check, in_words(link));
}

// Judges an interface from the outside in: present, of type CAN, up, then its settings.
Finding look_and_judge(Machine& machine, const CanNeed& need) {
  const std::string check = "CAN " + need.interface;
  const auto type = machine.text(kNet + need.interface + "/type");
  if (!type) {
    return {check, FindingState::mend, "no such interface",
            "ip -details link show type can   # those there are; plug the adapter in, or load "
            "its driver"};
  }
  if (*type != kCanType) {
    return {check, FindingState::mend, "is no CAN interface",
            "ip -details link show type can   # those there are"};
  }
  if (!is_up(machine, need.interface)) {
    return {check, FindingState::mend, "down", bring_up(need)};
  }
  return judge(need, look_at(machine, need.interface),
               machine.text(kNet + need.interface + "/mtu").value_or(""));
}

}  // namespace

void check_can(Machine& machine, const Needs& needs, Findings& findings) {
  std::vector<CanNeed> all = needs.can;
  if (needs.anything) {
    for (const std::string& interface : machine.names(kNet)) {
      if (machine.text(kNet + interface + "/type") == kCanType) {
        all.push_back({.interface = interface, .fd = false, .set_up = "bitrate 1000000"});
      }
    }
    if (all.empty()) {
      findings.push_back(well("CAN", "no interface"));
    }
  }
  for (const CanNeed& need : all) {
    findings.push_back(look_and_judge(machine, need));
  }
}

}  // namespace tactus::host
