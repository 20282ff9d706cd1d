// The CAN controllers that sit on a hat or a board: those that answer late or lose frames though
// their interface is up.
#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <string_view>

#include "host_tools/doctor/can_link.h"
#include "host_tools/doctor/checks.h"
#include "host_tools/doctor/raspberry_pi.h"

namespace tactus::host {

namespace {

// The kernel's name of Microchip's older controllers, the MCP2510 and MCP2515.
constexpr std::string_view kMcp251x = "mcp251x";

// An answer may wait for its interrupt for this share of a tick.
constexpr double kMostWait = 0.1;
// A bit of a CAN FD frame's data is sampled well from this many clocks on.
constexpr std::int64_t kLeastClocks = 8;
// The clock of SPI below which the transfers of a frame take longer than the frame, Hz.
constexpr std::uint32_t kLeastSpi_hz = 10'000'000;

// Judges the delay that the driver gives interrupts in order to read several frames at once.
Finding judge_interrupts(const CanNeed& need, const InterruptDelay& delay, double rate_hz) {
  const std::string check = "interrupts of " + need.interface;
  const double wait_s = 1e-6 * delay.microseconds;
  if (delay.frames <= 1 || wait_s <= kMostWait / rate_hz) {
    return well(check, delay.frames <= 1 ? "one a frame"
                                         : fmt::format("at most {} us late", delay.microseconds));
  }
  return {check, FindingState::mend,
          fmt::format("a drive's answer waits for up to {} us of a tick of {:.0f} us",
                      delay.microseconds, 1e6 / rate_hz),
          fmt::format("sudo ip link set {0} down; sudo ethtool -C {0} rx-usecs-irq 0 "
                      "rx-frames-irq 1; sudo ip link set {0} up type can {1}",
                      need.interface, need.set_up)};
}

// Judges the clock that the bits of CAN FD are made of.
Finding judge_clock(const CanNeed& need, const CanLink& link) {
  const std::string check = "clock of " + need.interface;
  const std::int64_t clocks = link.clock_hz / link.data_bitrate;
  const std::string found =
      fmt::format("{:g} MHz, {} a data bit", 1e-6 * static_cast<double>(link.clock_hz), clocks);
  if (clocks >= kLeastClocks) {
    return well(check, found);
  }
  return {
      check, FindingState::advice,
      fmt::format("{}: too few to place the sample point; use a controller with {:g} MHz, or a "
                  "lower data bit rate",
                  found, 1e-6 * static_cast<double>(kLeastClocks * link.data_bitrate)),
      fmt::format("ip -details link show {}   # after the change: sample-point and dsample-point",
                  need.interface)};
}

// Judges the clock of the SPI bus between processor and controller.
Finding judge_spi(Machine& machine, const CanNeed& need, std::uint32_t spi_hz) {
  const std::string check = "SPI of " + need.interface;
  const std::string found = fmt::format("up to {:g} MHz", 1e-6 * spi_hz);
  if (spi_hz >= kLeastSpi_hz) {
    return well(check, found);
  }
  return {check, FindingState::advice,
          found + ": reading a frame takes longer than its time on the bus",
          is_raspberry_pi(machine)
              ? "sudo sed -i '/^dtoverlay=mcp251xfd/s/$/,speed=20000000/' "
                "/boot/firmware/config.txt && sudo reboot"
              : "raise spi-max-frequency of the controller in the board's device tree"};
}

// Appends the findings on a controller that is there.
void judge_controller(Machine& machine, const Needs& needs, const CanNeed& need,
                      Findings& findings) {
  const CanLink link = can_link(machine, need.interface);
  if (const auto delay = machine.interrupt_delay(need.interface)) {
    findings.push_back(judge_interrupts(need, *delay, needs.rate_hz));
  }
  if (link.clock_hz > 0 && link.data_bitrate > 0) {
    findings.push_back(judge_clock(need, link));
  }
  if (const auto spi_hz = machine.device_tree_number(kNetworkFolder + need.interface +
                                                     "/device/of_node/spi-max-frequency")) {
    findings.push_back(judge_spi(machine, need, *spi_hz));
  }
  if (link.controller == kMcp251x) {
    findings.push_back(
        {"controller of " + need.interface, FindingState::advice,
         "MCP2515: it keeps two frames, and loses the third that comes before they are read",
         fmt::format("ip -statistics link show {}   # overrun counts what was lost; a hat with an "
                     "MCP2518FD keeps many frames",
                     need.interface)});
  }
}

}  // namespace

void check_can_controllers(Machine& machine, const Needs& needs, Findings& findings) {
  for (const CanNeed& need : can_to_look_at(machine, needs)) {
    if (is_can(machine, need.interface)) {
      judge_controller(machine, needs, need, findings);
    }
  }
}

}  // namespace tactus::host
