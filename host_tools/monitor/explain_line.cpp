#include "host_tools/monitor/explain_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>

#include "rendering/touch_names.h"

namespace tactus::host {
namespace {

using firmware::Explanation;
using rendering::ContactKind;
using rendering::ExplainedFeature;

// A line to which names with their values are added.
class Line {
 public:
  template <class Value>
  Line& add(std::string_view name, const Value& value) {
    fmt::format_to(std::back_inserter(text_), "{}{}={}", text_.empty() ? "" : " ", name, value);
    return *this;
  }
  Line& add(std::string_view name, double value) {
    fmt::format_to(std::back_inserter(text_), "{}{}={:.9g}", text_.empty() ? "" : " ", name, value);
    return *this;
  }
  Line& add(std::string_view name, const firmware::Triple& value, std::string_view unit) {
    constexpr std::string_view kAxes = "xyz";
    for (std::size_t i = 0; i < value.size(); ++i) {
      add(fmt::format("{}_{}{}", name, kAxes[i], unit), value[i]);
    }
    return *this;
  }
  // Adds the numbers of a feature, after a prefix of their names.
  Line& add(std::string_view prefix, const ExplainedFeature& feature) {
    add(fmt::format("{}face", prefix), feature.face);
    if (feature.kind == ContactKind::edge) {
      add(fmt::format("{}edge", prefix), feature.edge);
    }
    if (feature.kind == ContactKind::vertex) {
      add(fmt::format("{}vertex", prefix), feature.vertex);
    }
    return *this;
  }
  [[nodiscard]] std::string text() && { return std::move(text_); }

 private:
  std::string text_;
};

// Returns the word of an enumeration's value, or another one if this version does not know it.
template <std::size_t kCount, class Enum>
std::string_view state_word(const std::array<std::string_view, kCount>& words, Enum value) {
  const auto index = static_cast<std::size_t>(value);
  return index < kCount ? words[index] : "unknown";
}

void add_contact(const Explanation& explanation, Line& line) {
  line.add("object", explanation.feature.object);
  if (explanation.is_feature_known) {
    line.add("", explanation.feature);
  }
  line.add("surface", explanation.surface_W, "_m");
  line.add("normal", explanation.normal_W, "");
  line.add("depth_m", explanation.depth_m);
}

void add_planes(const Explanation& explanation, Line& line) {
  const std::size_t count =
      std::min<std::size_t>(explanation.plane_count, firmware::kMaxActivePlanes);
  line.add("planes", count);
  for (std::size_t i = 0; i < count; ++i) {
    const firmware::ActivePlane& plane = explanation.planes[i];
    const std::string prefix = fmt::format("plane{}_", i + 1);
    line.add(prefix + "object", plane.feature.object).add(prefix, plane.feature);
    line.add(prefix + "normal", plane.normal_W, "");
    line.add(prefix + "tool_distance_m", plane.tool_distance_m);
    line.add(prefix + "multiplier_m", plane.multiplier_m);
  }
}

}  // namespace

std::string_view contact_state(const Explanation& explanation) {
  constexpr std::array<std::string_view, 4> kStates = {"free", "face", "edge", "vertex"};
  return state_word(kStates, explanation.feature.kind);
}

std::string_view friction_word(const Explanation& explanation) {
  return state_word(rendering::kFrictionNames, explanation.friction);
}

std::string explain_line(const Explanation& explanation) {
  Line line;
  line.add("tick", explanation.tick).add("state", contact_state(explanation));
  line.add("friction", friction_word(explanation));
  line.add("moves", explanation.moves).add("iterations", explanation.iterations);
  line.add("tool", explanation.tool_W, "_m").add("proxy", explanation.proxy_W, "_m");
  if (explanation.feature.kind != ContactKind::none) {
    add_contact(explanation, line);
  }
  add_planes(explanation, line);
  if (explanation.has_circle) {
    line.add("static_radius_m", explanation.circle.static_radius_m);
    line.add("dynamic_radius_m", explanation.circle.dynamic_radius_m);
    line.add("lag_m", explanation.circle.lag_m);
  }
  for (std::size_t step = 0; step < explanation.step_ns.size(); ++step) {
    line.add(fmt::format("{}_ns", firmware::kTickStepNames[step]), explanation.step_ns[step]);
  }
  return std::move(line).text();
}

}  // namespace tactus::host
