#include "host_tools/doctor/can_link.h"

#include <nlohmann/json.hpp>

namespace tactus::host {

namespace {

// The kernel's constant ARPHRD_CAN as sysfs prints it.
constexpr const char* kCanType = "280";

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
    link.clock_hz = data.value("clock", std::int64_t{0});
    const nlohmann::json limits = data.value("bittiming_const", nlohmann::json::object());
    link.controller = limits.is_object() ? limits.value("name", "") : "";
    link.state = data.value("state", "");
  }
  return link;
}

}  // namespace

std::vector<CanNeed> can_to_look_at(Machine& machine, const Needs& needs) {
  std::vector<CanNeed> all = needs.can;
  if (needs.anything) {
    for (const std::string& interface : machine.names(kNetworkFolder)) {
      if (is_can(machine, interface)) {
        all.push_back({.interface = interface, .set_up = "bitrate 1000000"});
      }
    }
  }
  return all;
}

bool is_can(Machine& machine, const std::string& interface) {
  return machine.text(kNetworkFolder + interface + "/type") == kCanType;
}

CanLink can_link(Machine& machine, const std::string& interface) {
  try {
    return link_from(machine.ip_link(interface).value_or(""));
  } catch (const nlohmann::json::exception&) {
    return {};  // an `ip` that writes other types than the one that is known
  }
}

}  // namespace tactus::host
