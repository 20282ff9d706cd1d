// Checks that a line of a GPIO chip is used once, and a gpio connection by one axis.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "firmware/device_file/device_checks.h"

namespace tactus::firmware {

namespace {

using drivers::UsedLine;
using drivers::UsedLines;

// The lines that an axis uses, and their chip; empty for an axis without a chip.
struct LinesOfAxis {
  std::string_view chip;
  std::string_view kind;  // of the connection
  UsedLines lines;
};

LinesOfAxis lines_of(const DeviceConfig& device, const AxisConfig& axis) {
  LinesOfAxis used;
  drivers::visit_connection(device.connections[axis.connection].line,
                            [&](const auto& kind, const auto& line) {
                              used.kind = kind.kind;
                              used.chip = kind.chip == nullptr ? "" : kind.chip(line);
                            });
  drivers::visit_drive(axis.drive, [&](const auto& driver, const auto& drive) {
    used.lines = driver.lines == nullptr ? UsedLines{} : driver.lines(drive);
  });
  return used;
}

// Returns the key of the first of the lines with this offset, or an empty text.
std::string_view key_at(std::span<const UsedLine> lines, std::uint32_t offset) {
  const auto found = std::ranges::find(lines, std::optional(offset), &UsedLine::offset);
  return found == lines.end() ? std::string_view{} : found->key;
}

std::unexpected<Refusal> refuse_pin(std::size_t axis, std::string_view key, Words& words) {
  words.add("; give each a line of its own");
  return std::unexpected(Refusal{Place::axis, axis, key, words.view()});
}

// Checks line `p` of axis i, which has this offset, against the lines before it and those of
// earlier axes on the same chip.
Verdict check_pin(const DeviceConfig& device, std::size_t i, std::size_t p, std::uint32_t offset,
                  Words& words) {
  const auto [chip, kind, lines] = lines_of(device, device.axes[i]);
  words.clear();
  words.add("is line ").add(offset).add(", which is also ");
  if (const auto key = key_at(std::span(lines).first(p), offset); !key.empty()) {
    words.add(key);
    return refuse_pin(i, lines[p].key, words);
  }
  for (const AxisConfig& other : std::span(device.axes).first(i)) {
    const LinesOfAxis taken = lines_of(device, other);
    const auto key = taken.chip == chip ? key_at(taken.lines, offset) : std::string_view{};
    if (!key.empty()) {
      words.add(key).add(" of axis \"").add(other.name).add("\"");
      return refuse_pin(i, lines[p].key, words);
    }
  }
  if (device.watchdog_line && device.watchdog_line->offset == offset &&
      device.watchdog_chip == chip) {
    words.add("the device's watchdog_line");
    return refuse_pin(i, lines[p].key, words);
  }
  return {};
}

Verdict check_axis_pins(const DeviceConfig& device, std::size_t i, Words& words) {
  const UsedLines lines = lines_of(device, device.axes[i]).lines;
  for (std::size_t p = 0; p < lines.size(); ++p) {
    if (const std::optional<std::uint32_t> offset = lines[p].offset) {
      if (const Verdict verdict = check_pin(device, i, p, *offset, words); !verdict) {
        return verdict;
      }
    }
  }
  return {};
}

}  // namespace

// Two axes on one connection with a chip are refused: they would share its PWM channel.
Verdict check_pins(const DeviceConfig& device, Words& words) {
  for (std::size_t i = 0; i < device.axis_count; ++i) {
    const AxisConfig& axis = device.axes[i];
    const LinesOfAxis used = lines_of(device, axis);
    if (used.chip.empty()) {
      continue;
    }
    for (const AxisConfig& other : std::span(device.axes).first(i)) {
      if (other.connection == axis.connection) {
        words.clear();
        words.add("is also that of axis \"")
            .add(other.name)
            .add("\"; a ")
            .add(used.kind)
            .add(" connection carries one axis: give each its own");
        return std::unexpected(Refusal{Place::axis, i, "connection", words.view()});
      }
    }
    if (const Verdict verdict = check_axis_pins(device, i, words); !verdict) {
      return verdict;
    }
  }
  return {};
}

}  // namespace tactus::firmware
