#include "host_tools/simulation/run_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string_view>

#include "firmware/safety/faults.h"
#include "rendering/touch.h"

namespace tactus::host {
namespace {

// The names in the order of the bits of rendering::kTouch...
constexpr std::array<std::string_view, kTouchFlagCount> kTouchFlagNames = {
    "candidates_overflow",
    "iterations_exhausted",
    "planes_overflow",
    "tool_invalid",
    "pinched",
    "overlap",
    "body_contacts_overflow"};
static_assert(rendering::kTouchBodyContactsOverflow == 1U << (kTouchFlagCount - 1));

double magnitude(const firmware::Triple& v) {
  return Vec3(v[0], v[1], v[2]).norm();
}

// Returns the time of that many ticks, s.
double seconds(const RunSummary& summary, std::uint64_t ticks) {
  return static_cast<double>(ticks) / summary.rate_hz;
}

// Returns which bit the fault is.
std::size_t bit_index(const firmware::FaultText& text) {
  return static_cast<std::size_t>(firmware::fault_code(text.bit));
}

// faults_text(), limits_text() and overflow_text() return lines of the summary; limits_text() none
// if there were no limits.
std::string faults_text(const RunSummary& summary) {
  if (summary.faults == 0) {
    return "faults      none\n";
  }
  std::string text;
  for (const firmware::FaultText& fault : firmware::kFaultTexts) {
    if ((summary.faults & fault.bit) != 0) {
      fmt::format_to(std::back_inserter(text), "fault       {}: {}\n", fault.name, fault.meaning);
    }
  }
  fmt::format_to(std::back_inserter(text), "            first at {:.3f} s\n",
                 summary.first_fault_s);
  return text;
}

std::string limits_text(const RunSummary& summary) {
  std::string text;
  for (const firmware::FaultText& limit : firmware::kFaultTexts) {
    const std::uint64_t ticks = summary.limited_ticks[bit_index(limit)];
    if (ticks != 0) {
      fmt::format_to(std::back_inserter(text), "limited     {:.3f} s: {}\n",
                     seconds(summary, ticks), limit.meaning);
    }
  }
  return text;
}

std::string overflow_text(const RunSummary& summary) {
  std::string text;
  for (std::size_t i = 0; i < kTouchFlagCount; ++i) {
    if (summary.flagged_ticks[i] != 0) {
      fmt::format_to(std::back_inserter(text), "overflow    {} in {} ticks\n", kTouchFlagNames[i],
                     summary.flagged_ticks[i]);
    }
  }
  return text.empty() ? "overflow    none\n" : text;
}

}  // namespace

void RunSummary::add(const firmware::TelemetryRecord& record) {
  ++ticks;
  contact_ticks += record.contact != rendering::ContactKind::none ? 1U : 0U;
  stick_ticks += record.friction == rendering::FrictionState::stick ? 1U : 0U;
  slip_ticks += record.friction == rendering::FrictionState::slip ? 1U : 0U;
  max_force_N = std::max(max_force_N, magnitude(record.force_rendered_W));
  max_commanded_N = std::max(max_commanded_N, magnitude(record.force_commanded_W));
  max_depth_m = std::max(max_depth_m, record.depth_m);
  if (faults == 0 && record.faults != 0) {
    first_fault_s = record.time_s;
  }
  faults |= record.faults;
  if (record.limits != 0) {
    for (std::size_t bit = 0; bit < limited_ticks.size(); ++bit) {
      limited_ticks[bit] += (record.limits >> bit) & 1U;
    }
  }
  if (record.touch_flags != 0) {
    for (std::size_t bit = 0; bit < kTouchFlagCount; ++bit) {
      flagged_ticks[bit] += (record.touch_flags >> bit) & 1U;
    }
  }
  stale_samples = record.counters.stale_samples;
  mode = record.mode;
  state_hash = record.state_hash;
}

std::string summary_text(const RunSummary& summary) {
  std::string text =
      fmt::format("simulated   {:.3f} s in {:.3f} s of wall time ({:.0f} times real time)\n",
                  summary.simulated_s(), summary.wall_s, summary.ratio());
  if (summary.contact_ticks == 0) {
    text += "contact     none: the tool touched nothing; a wish path leads it elsewhere (--path)\n";
  } else {
    fmt::format_to(std::back_inserter(text),
                   "contact     {:.3f} s ({:.3f} s stick, {:.3f} s slip)\n",
                   seconds(summary, summary.contact_ticks), seconds(summary, summary.stick_ticks),
                   seconds(summary, summary.slip_ticks));
  }
  fmt::format_to(std::back_inserter(text),
                 "force       up to {:.3f} N rendered, {:.3f} N commanded\n", summary.max_force_N,
                 summary.max_commanded_N);
  fmt::format_to(std::back_inserter(text), "depth       up to {:.3f} mm\n",
                 1e3 * summary.max_depth_m);
  text += faults_text(summary) + limits_text(summary) + overflow_text(summary);
  fmt::format_to(std::back_inserter(text), "mode        {} at the end\nhash        {:016x}\n",
                 firmware::mode_name(summary.mode), summary.state_hash);
  return text;
}

std::string summary_json(const RunSummary& summary) {
  nlohmann::ordered_json faults = nlohmann::ordered_json::array();
  nlohmann::ordered_json limits = nlohmann::ordered_json::object();
  nlohmann::ordered_json flags = nlohmann::ordered_json::object();
  for (const firmware::FaultText& text : firmware::kFaultTexts) {
    if ((summary.faults & text.bit) != 0) {
      faults.push_back(text.name);
    }
    if (const std::uint64_t ticks = summary.limited_ticks[bit_index(text)]; ticks != 0) {
      limits[std::string(text.name)] = ticks;
    }
  }
  for (std::size_t i = 0; i < kTouchFlagCount; ++i) {
    flags[std::string(kTouchFlagNames[i])] = summary.flagged_ticks[i];
  }
  const nlohmann::ordered_json json{
      {"ticks", summary.ticks},
      {"rate_hz", summary.rate_hz},
      {"simulated_s", summary.simulated_s()},
      {"wall_s", summary.wall_s},
      {"simulated_s_per_s", summary.ratio()},
      {"contact_s", seconds(summary, summary.contact_ticks)},
      {"stick_s", seconds(summary, summary.stick_ticks)},
      {"slip_s", seconds(summary, summary.slip_ticks)},
      {"max_force_N", summary.max_force_N},
      {"max_commanded_N", summary.max_commanded_N},
      {"max_depth_m", summary.max_depth_m},
      {"faults", faults},
      {"limited_ticks", limits},
      {"touch_flags", flags},
      {"stale_samples", summary.stale_samples},
      {"mode", firmware::mode_name(summary.mode)},
      {"hash", fmt::format("{:016x}", summary.state_hash)},
  };
  return json.dump() + "\n";
}

}  // namespace tactus::host
