#include "host_tools/commission/commission_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iterator>
#include <nlohmann/json.hpp>
#include <span>

#include "firmware/device_file/device_certificate.h"
#include "firmware/device_file/device_commissioning.h"
#include "host_tools/files/atomic_file.h"

namespace tactus::host {
namespace {

using firmware::Verdict;

// The units of a joint that turns or slides, as text.
struct Units {
  const char* position;
  const char* effort;
  const char* inertia;
  const char* viscous;
};

constexpr Units kTurning{"rad", "N m", "kg m^2", "N m s/rad"};
constexpr Units kSliding{"m", "N", "kg", "N s/m"};

const Units& units_of(const JointReport& joint) {
  return joint.slides ? kSliding : kTurning;
}

// Returns true if a pulse was measured.
bool has_fit(const JointReport& joint) {
  return joint.fit.explained > 0.0;
}

void append_numbers(std::string& text, const JointReport& joint) {
  const Units& unit = units_of(joint);
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "  travel    {:.4g} to {:.4g} {} by hand; limits {:.4g} to {:.4g}\n",
                 joint.travel.lower, joint.travel.upper, unit.position, joint.lower, joint.upper);
  if (!has_fit(joint)) {
    return;
  }
  fmt::format_to(out, "  pulse     {:.3g} {} moved it {:.3g} {}, {:.0f} % explained\n",
                 joint.effort, unit.effort, joint.fit.travel, unit.position,
                 100.0 * joint.fit.explained);
  fmt::format_to(out, "  inertia   {:.3g} {}, expected {:.3g}\n", joint.fit.inertia, unit.inertia,
                 joint.expected_inertia);
  fmt::format_to(out, "  friction  {:.3g} {}, {:.3g} {}\n", joint.fit.friction, unit.effort,
                 joint.fit.viscous, unit.viscous);
  fmt::format_to(out, "  delay     {} ticks\n", joint.fit.delay_ticks);
  if (joint.fit.reported_share != 0.0) {
    fmt::format_to(out, "  torque    the drive reports {:.2f} times what was commanded\n",
                   joint.fit.reported_share);
  }
}

// Returns one number of every joint.
std::vector<double> each(const CommissionReport& report, double (*number)(const JointReport&)) {
  std::vector<double> numbers;
  numbers.reserve(report.joints.size());
  for (const JointReport& joint : report.joints) {
    numbers.push_back(number(joint));
  }
  return numbers;
}

}  // namespace

std::string report_text(const CommissionReport& report) {
  std::string text;
  for (const JointReport& joint : report.joints) {
    const firmware::VerdictText& words = firmware::text_of(joint.verdict);
    const bool passed = joint.verdict == Verdict::passed;
    fmt::format_to(std::back_inserter(text), "{:<12} {}{}\n", joint.name,
                   passed ? "passed: " : "FAILED: ", words.what);
    append_numbers(text, joint);
    if (!passed) {
      fmt::format_to(std::back_inserter(text), "  remedy    {}\n", words.remedy);
    }
  }
  if (!report.trouble.empty()) {
    fmt::format_to(std::back_inserter(text), "the device stopped it: {}\n", report.trouble);
  }
  return text;
}

std::string report_json(const CommissionReport& report) {
  nlohmann::ordered_json json{{"passed", report.has_passed()},
                              {"trouble", report.trouble},
                              {"joints", nlohmann::ordered_json::array()}};
  for (const JointReport& joint : report.joints) {
    json["joints"].push_back({{"name", joint.name},
                              {"verdict", firmware::text_of(joint.verdict).name},
                              {"inertia", joint.fit.inertia},
                              {"expected_inertia", joint.expected_inertia},
                              {"friction", joint.fit.friction},
                              {"viscous", joint.fit.viscous},
                              {"delay_ticks", joint.fit.delay_ticks},
                              {"explained", joint.fit.explained},
                              {"reported_share", joint.fit.reported_share},
                              {"pulse_effort", joint.effort},
                              {"pulse_travel", joint.fit.travel},
                              {"travel", {joint.travel.lower, joint.travel.upper}},
                              {"limits", {joint.lower, joint.upper}}});
  }
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

void write_commissioning(const std::filesystem::path& file, const CommissionReport& report,
                         const std::string& measured_with, std::uint64_t settings_checksum) {
  const auto list = [&](double (*number)(const JointReport&)) {
    return fmt::format("[{}]", fmt::join(each(report, number), ", "));
  };
  const std::string text = fmt::format(
      "# Written by tactus commission, for tactus bake: how each joint answered its motor.\n"
      "[commissioning]\n"
      "{} = {}\n{} = {}\n{} = {}\n{} = {}\n{} = {}\n{} = \"{}\"\n{} = \"{}\"\n",
      firmware::kCommissioningPassed, report.has_passed(), firmware::kCommissioningInertia,
      list([](const JointReport& joint) { return joint.fit.inertia; }),
      firmware::kCommissioningMass, report.moving_mass_kg, firmware::kCommissioningFriction,
      list([](const JointReport& joint) { return joint.fit.friction; }),
      firmware::kCommissioningDelay,
      list([](const JointReport& joint) { return static_cast<double>(joint.fit.delay_ticks); }),
      firmware::kCommissioningMethod, measured_with, firmware::kCommissioningSettings,
      firmware::checksum_text(settings_checksum).view());
  write_file_atomically(file, std::as_bytes(std::span(text)));
}

}  // namespace tactus::host
