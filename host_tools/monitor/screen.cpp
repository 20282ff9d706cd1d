// The layout of the screen by rows: 0 head, 1-4 faults and limits, 5-12 axes and wake-up latency,
// or the explanation of a tick,
// 13-18 touch and loop, 19-21 energy, 22 the controller's answer, 23 keys.
#include "host_tools/monitor/screen.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string_view>

#include "firmware/safety/energy_ledger.h"
#include "host_tools/monitor/explain_panel.h"

namespace tactus::host {

namespace {

using firmware::Mode;
using firmware::RecordedTick;

constexpr std::size_t kFaultRow = 1;
constexpr std::size_t kFaultRows = 4;
constexpr std::size_t kAxesRow = 5;
constexpr std::size_t kTouchRow = 13;
constexpr std::size_t kEnergyRow = 19;
constexpr std::size_t kAnswerRow = 22;
constexpr std::size_t kKeysRow = 23;
constexpr std::size_t kRightColumn = 48;
// A time beyond 32 years is not a time of a run.
constexpr double kMostTime_s = 1e9;

// Returns a number in nine columns, whatever its size.
std::string number(double value, int digits) {
  if (!std::isfinite(value)) {
    return fmt::format("{:>9}", std::isnan(value) ? "no number" : "infinite");
  }
  return std::abs(value) < 1e6 ? fmt::format("{:>9.{}f}", value, digits)
                               : fmt::format("{:>9.1e}", value);
}

Style style_of(Mode mode) {
  switch (mode) {
    case Mode::active:
      return Style::good;
    case Mode::fault:
      return Style::bad;
    default:
      return Style::strong;
  }
}

// Returns the mode's name; a newer controller may have a mode that this version does not know.
std::string_view known_name(Mode mode) {
  const auto index = static_cast<std::size_t>(mode);
  return index < firmware::kModeNames.size() ? firmware::kModeNames[index] : "unknown";
}

// Draws a horizontal line with a title at the left and one at the right.
void rule(Canvas& canvas, std::size_t row, std::string_view left, std::string_view right) {
  canvas.put(row, 0, std::string(kScreenColumns, '-'), Style::faint);
  canvas.put(row, 2, fmt::format(" {} ", left));
  if (!right.empty()) {
    canvas.put(row, kRightColumn, fmt::format(" {} ", right));
  }
}

void draw_head(Canvas& canvas, const RunView& view) {
  canvas.put(0, 0, "tactus");
  canvas.put(0, 7, view.name().substr(0, 36), Style::strong);
  const std::optional<RecordedTick>& newest = view.newest();
  if (view.lost() || !newest) {
    canvas.put(0, 46, view.lost() ? "CONTROLLER GONE" : "waiting for the first tick",
               Style::warning);
    return;
  }
  const auto& record = newest->record;
  std::string mode(known_name(record.mode));
  std::ranges::transform(mode, mode.begin(), [](char c) { return c >= 'a' ? c - 'a' + 'A' : c; });
  canvas.put(0, 46, fmt::format(" {} ", mode), style_of(record.mode));
  const bool can_be_told = record.time_s >= 0.0 && record.time_s < kMostTime_s;
  const auto seconds = static_cast<std::uint64_t>(can_be_told ? record.time_s : 0.0);
  const std::string when = fmt::format("tick {} {:02}:{:02}:{:02}", record.tick, seconds / 3600,
                                       seconds / 60 % 60, seconds % 60);
  canvas.put(0, kScreenColumns - std::min(when.size(), kScreenColumns), when);
}

// Draws as many faults with their remedies as fit, and how many more there are. Limits get the last
// row.
void draw_faults(Canvas& canvas, const RecordedTick& tick) {
  const FaultWords words = fault_words(tick.record.faults, tick.record.limits);
  const std::size_t room = (words.limits.empty() ? kFaultRows : kFaultRows - 1) / 2;
  std::size_t row = kFaultRow;
  for (std::size_t i = 0; i < std::min(room, words.faults.size()); ++i) {
    canvas.put(row++, 0, "! " + words.faults[i], Style::bad);
    const std::size_t more = words.faults.size() - room;
    const bool cut = i + 1 == room && words.faults.size() > room;
    canvas.put(row++, 0,
               "  > " + words.remedies[i] + (cut ? fmt::format("; and {} more", more) : ""),
               Style::warning);
  }
  if (words.faults.empty()) {
    canvas.put(row++, 0, "no fault");
  }
  if (!words.limits.empty()) {
    canvas.put(row, 0, "~ " + words.limits, Style::warning);
  }
}

void draw_axes(Canvas& canvas, const RecordedTick& tick) {
  rule(canvas, kAxesRow, "axes, rad or m", "wake-up latency, us");
  canvas.put(kAxesRow + 1, 0, "     position  velocity    effort  friction", Style::faint);
  const auto& record = tick.record;
  const std::size_t count = std::min<std::size_t>(tick.joint_count, drivers::kMaxJoints);
  for (std::size_t i = 0; i < count; ++i) {
    canvas.put(kAxesRow + 2 + i, 0,
               fmt::format("{:>2}  {} {} {} {}", i + 1, number(record.joint_position[i], 5),
                           number(record.joint_velocity[i], 4), number(record.joint_effort[i], 4),
                           number(record.joint_compensation[i], 4)));
  }
}

// A range of latencies that shares a bar.
struct LatencyBand {
  std::string_view name;
  // The band ends before this latency.
  std::size_t end_us;
};
constexpr std::array<LatencyBand, 6> kLatencyBands = {{{"   <5", 5},
                                                       {"  <10", 10},
                                                       {"  <20", 20},
                                                       {"  <50", 50},
                                                       {" <200", 200},
                                                       {">=200", firmware::kTimeBins}}};

// Returns the length of a bar by the logarithm of the share, so that one late tick in a million
// shows.
std::size_t bar_length(std::uint64_t count, std::uint64_t all, std::size_t room) {
  if (count == 0) {
    return 0;
  }
  const double share = std::log10(static_cast<double>(count)) /
                       std::log10(static_cast<double>(std::max<std::uint64_t>(all, 10)));
  return std::max<std::size_t>(1, static_cast<std::size_t>(share * static_cast<double>(room)));
}

void draw_latency(Canvas& canvas, const RunView& view) {
  const firmware::TimeHistogram& histogram = view.wake_up();
  if (histogram.count() == 0) {
    canvas.put(kAxesRow + 1, kRightColumn, "none: this loop does not sleep", Style::faint);
    return;
  }
  constexpr std::size_t kBarRoom = 14;
  std::size_t begin = 0;
  for (std::size_t i = 0; i < kLatencyBands.size(); ++i) {
    const LatencyBand& band = kLatencyBands[i];
    std::uint64_t count = 0;
    for (; begin < band.end_us; ++begin) {
      count += histogram.bins()[begin];
    }
    const bool last = i + 1 == kLatencyBands.size();
    count += last ? histogram.overflow() : 0;
    const std::size_t row = kAxesRow + 1 + i;
    canvas.put(row, kRightColumn, fmt::format("{} {:>9}", band.name, count));
    canvas.put(row, kRightColumn + 16,
               std::string(bar_length(count, histogram.count(), kBarRoom), '#'),
               band.end_us > 200 ? Style::bad : Style::bar);
  }
  canvas.put(kAxesRow + 7, kRightColumn,
             fmt::format("mean {:.1f}, longest {:.1f}", 1e-3 * histogram.mean_ns(),
                         1e-3 * static_cast<double>(histogram.max_ns())));
}

void draw_triple(Canvas& canvas, std::size_t row, std::string_view name,
                 const firmware::Triple& value, double scale, int digits) {
  canvas.put(row, 0,
             fmt::format("{:<10}{} {} {}", name, number(scale * value[0], digits),
                         number(scale * value[1], digits), number(scale * value[2], digits)));
}

// Describes what the proxy touches.
std::string contact_words(const firmware::TelemetryRecord& record) {
  constexpr std::array<std::string_view, 4> kKinds = {"no contact", "face", "edge", "vertex"};
  constexpr std::array<std::string_view, 3> kFriction = {"free", "sticks", "slips"};
  const auto kind = static_cast<std::size_t>(record.contact);
  const auto friction = static_cast<std::size_t>(record.friction);
  if (kind == 0 || kind >= kKinds.size()) {
    return std::string(kKinds[0]);
  }
  return fmt::format("{:.3f} mm deep, {} of object {}, {}", 1e3 * record.depth_m, kKinds[kind],
                     record.object, friction < kFriction.size() ? kFriction[friction] : "");
}

void draw_force_bar(Canvas& canvas, std::size_t row, const RunView& view,
                    const RecordedTick& tick) {
  constexpr std::size_t kBarRoom = 20;
  const auto& force = tick.record.force_commanded_W;
  const double force_N = std::hypot(force[0], force[1], force[2]);
  const double share = std::isfinite(force_N) ? force_N / view.force_scale_N() : 0.0;
  const auto length = static_cast<std::size_t>(std::lround(share * kBarRoom));
  const std::string filled(std::min(length, kBarRoom), '#');
  canvas.put(row, 0,
             fmt::format("|force|   {} N |{:<{}}| {:g}", number(force_N, 3), filled, kBarRoom,
                         view.force_scale_N()));
  canvas.paint(row, 23, filled.size(), Style::bar);
}

void draw_touch(Canvas& canvas, const RunView& view, const RecordedTick& tick) {
  rule(canvas, kTouchRow, "touch: x right, y up, z to you", "loop");
  const auto& record = tick.record;
  draw_triple(canvas, kTouchRow + 1, "tool mm", record.tool_p_W, 1e3, 3);
  draw_triple(canvas, kTouchRow + 2, "proxy mm", record.proxy_W, 1e3, 3);
  draw_triple(canvas, kTouchRow + 3, "force N", record.force_commanded_W, 1.0, 3);
  draw_force_bar(canvas, kTouchRow + 4, view, tick);
  canvas.put(kTouchRow + 5, 0, contact_words(record));
}

void draw_loop(Canvas& canvas, const RunView& view, const RecordedTick& tick) {
  const firmware::StageTimes& stage = tick.record.stage_ns;
  const auto us = [](std::uint32_t ns) { return 1e-3 * ns; };
  std::size_t row = kTouchRow + 1;
  canvas.put(row++, kRightColumn,
             fmt::format("{:.1f} Hz, {} late", view.rate_hz(), view.late_ticks()));
  if (view.tick_time().count() > 0) {
    canvas.put(row, kRightColumn,
               fmt::format("tick {:.1f} us, longest {:.1f}", 1e-3 * view.tick_time().mean_ns(),
                           1e-3 * static_cast<double>(view.tick_time().max_ns())));
  }
  ++row;
  canvas.put(row++, kRightColumn,
             fmt::format("read {:.1f} touch {:.1f} write {:.1f}", us(stage.read), us(stage.touch),
                         us(stage.write)));
  canvas.put(row++, kRightColumn, fmt::format("sample {} us old", tick.record.sample_age_us));
  canvas.put(row, kRightColumn,
             fmt::format("{} not recorded, {} not seen", tick.dropped, view.missing()),
             tick.dropped > 0 ? Style::warning : Style::plain);
}

void draw_energy(Canvas& canvas, const RecordedTick& tick) {
  rule(canvas, kEnergyRow, "energy to the hand, J, since enable", "");
  constexpr std::size_t kInRow = 4;
  constexpr std::size_t kWidth = 20;
  for (std::size_t i = 0; i < firmware::kEnergySourceCount; ++i) {
    canvas.put(kEnergyRow + 1 + i / kInRow, kWidth * (i % kInRow),
               fmt::format("{:<9}{}", firmware::kEnergySourceNames[i],
                           number(tick.record.energy_J[i], 4)));
  }
  canvas.put(kEnergyRow + 2, kWidth * 3,
             fmt::format("{:<9}{}", "observer", number(tick.record.passivity_J, 4)),
             tick.record.passivity_J < 0.0 ? Style::warning : Style::plain);
}

}  // namespace

Canvas draw_screen(const RunView& view) {
  Canvas canvas;
  draw_head(canvas, view);
  if (const std::optional<RecordedTick>& newest = view.newest()) {
    const RecordedTick& tick = *newest;
    draw_faults(canvas, tick);
    if (const auto& explanation = view.explanation()) {
      rule(canvas, kAxesRow, fmt::format("tick {} explained", explanation->tick),
           "the loop's steps, us");
      draw_explanation(canvas, kAxesRow + 1, kRightColumn, *explanation);
    } else {
      draw_axes(canvas, tick);
      draw_latency(canvas, view);
    }
    draw_touch(canvas, view, tick);
    draw_loop(canvas, view, tick);
    draw_energy(canvas, tick);
  }
  canvas.put(kAnswerRow, 0, view.said(),
             view.said().starts_with("ok") ? Style::plain : Style::warning);
  canvas.put(kKeysRow, 0,
             "h home   e enable   d disable   r reset   x explain   SPACE estop   q quit",
             Style::strong);
  return canvas;
}

}  // namespace tactus::host
