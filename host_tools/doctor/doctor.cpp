#include "host_tools/doctor/doctor.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "host_tools/doctor/checks.h"

#include "host_tools/terminal_colour.h"

namespace tactus::host {

namespace {

// The order is that of importance: a user mends the first lines first.
constexpr std::array kMachineChecks{
    check_kernel,       check_real_time_priority,  check_locked_memory,
    check_group,        check_cpu_latency,         check_frequency_governor,
    check_clock_source, check_isolated_processors, check_real_time_throttling,
    check_huge_pages,   check_compaction,          check_swap,
    check_power,
};
constexpr std::array kDeviceChecks{
    check_tick_budget, check_motors,       check_can, check_can_controllers,
    check_falcon,      check_serial_ports, check_gpio};

const char* state_name(FindingState state) {
  switch (state) {
    case FindingState::well:
      return "well";
    case FindingState::advice:
      return "advice";
    case FindingState::mend:
      return "mend";
    case FindingState::not_looked:
      return "unknown";
  }
  return "";
}

TerminalColour colour_of(FindingState state) {
  switch (state) {
    case FindingState::well:
      return TerminalColour::green;
    case FindingState::advice:
      return TerminalColour::cyan;
    case FindingState::mend:
      return TerminalColour::red;
    case FindingState::not_looked:
      return TerminalColour::yellow;
  }
  return TerminalColour::yellow;
}

std::ptrdiff_t count_of(const Findings& findings, FindingState state) {
  return std::ranges::count(findings, state, &Finding::state);
}

}  // namespace

Findings examine(Machine& machine, const Needs& needs) {
  Findings findings;
  for (const auto check : kMachineChecks) {
    check(machine, findings);
  }
  for (const auto check : kDeviceChecks) {
    check(machine, needs, findings);
  }
  return findings;
}

int exit_code(const Findings& findings) {
  if (count_of(findings, FindingState::mend) > 0) {
    return 1;
  }
  return count_of(findings, FindingState::not_looked) > 0 ? 2 : 0;
}

std::string in_words(const Findings& findings, bool colours) {
  std::string text;
  for (const Finding& finding : findings) {
    const std::string state = fmt::format("{:<8}", state_name(finding.state));
    text += fmt::format("{}{:<24}{}\n", colours ? coloured(state, colour_of(finding.state)) : state,
                        finding.check, finding.found);
    if (!finding.remedy.empty()) {
      text += fmt::format("{:>8}{}\n", "> ", finding.remedy);
    }
  }
  const auto mend = count_of(findings, FindingState::mend);
  const auto unknown = count_of(findings, FindingState::not_looked);
  if (mend == 0 && unknown == 0) {
    return text + "ready for real time\n";
  }
  return text + fmt::format("{} to mend{}\n", mend,
                            unknown > 0 ? fmt::format(", {} could not be looked at", unknown) : "");
}

std::string in_json(const Findings& findings) {
  std::string text;
  for (const Finding& finding : findings) {
    const nlohmann::ordered_json json{{"check", finding.check},
                                      {"state", state_name(finding.state)},
                                      {"found", finding.found},
                                      {"remedy", finding.remedy}};
    // Names of interfaces come from the kernel as bytes; whatever is not UTF-8 is replaced.
    text += json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
  }
  return text;
}

}  // namespace tactus::host
