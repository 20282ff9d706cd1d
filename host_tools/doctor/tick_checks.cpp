#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host_tools/doctor/checks.h"
#include "rendering/tick_budget.h"

namespace tactus::host {
namespace {

// The share of a tick's period that the rendering may take: with more than the first, little is
// left for devices and guards; with more than the second, the tick ends late.
constexpr double kGoodShare = 0.5;
constexpr double kMostShare = 0.8;

// Returns the number rounded down to two digits.
double two_digits_below(double value) {
  const double step = std::pow(10.0, std::floor(std::log10(value)) - 1.0);
  return step * std::floor(value / step);
}

}  // namespace

void check_tick_budget(Machine& machine, const Needs& needs, Findings& findings) {
  const auto unit_ns = machine.unit_cost_ns();
  if (!unit_ns || !(*unit_ns > 0.0)) {
    findings.push_back({"tick budget", FindingState::not_looked,
                        "the recorded machine does not say how fast it renders",
                        "record it again there: tactus doctor --save FOLDER"});
    return;
  }
  const double ns_per_instruction = *unit_ns / rendering::kInstructionsPerUnit;
  const double period_ns = 1e9 / needs.rate_hz;
  const double time_ns = needs.tick_instructions * ns_per_instruction;
  const std::string found =
      fmt::format("{:.3g} million instructions take up to {:.2f} of {:.2f} ms",
                  1e-6 * needs.tick_instructions, 1e-6 * time_ns, 1e-6 * period_ns);
  if (time_ns <= kGoodShare * period_ns) {
    findings.push_back(well("tick budget", found));
    return;
  }
  const double fitting = two_digits_below(kGoodShare * period_ns / ns_per_instruction);
  findings.push_back({"tick budget",
                      time_ns > kMostShare * period_ns ? FindingState::mend : FindingState::advice,
                      found,
                      fmt::format("tick_instructions = {:.0f} below [controller] in the device's "
                                  "file, or a lower rate_hz",
                                  fitting)});
}

}  // namespace tactus::host
