#include "host_tools/plot/tick_panel.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>

#include "host_tools/plot/mesh_cut.h"
#include "host_tools/plot/tick_script.h"
#include "rendering/touch_names.h"

namespace tactus::host {
namespace {

// A data block of gnuplot.
class Block {
 public:
  explicit Block(std::string name) : text_(fmt::format("${} << EOD\n", name)) {}

  // Adds a row of numbers.
  template <class... Numbers>
  void add(Numbers... numbers) {
    (fmt::format_to(std::back_inserter(text_), "{:.7g} ", numbers), ...);
    text_ += '\n';
  }
  void add_point(const PlanePoint& p) { add(p.right, p.up); }
  void lift_pen() { text_ += '\n'; }
  // Returns the block; gnuplot complains about one without points, so it gets one off the sheet.
  [[nodiscard]] std::string finish() const { return text_ + "1e9 1e9 0 0\nEOD\n"; }

 private:
  std::string text_;
};

// Returns the lines in which the picture's plane cuts the objects, where they can be seen.
std::string cut_block(const TickPanel& panel, std::span<const rendering::Object> objects) {
  const TickView& view = panel.view;
  const Window& window = panel.window;
  Block block("cut_" + panel.suffix);
  // A panel with a field shows the formula itself, and not the mesh that is its picture.
  for (const rendering::Object& object : objects) {
    if (panel.from_above ||
        (panel.field != nullptr && object.surface == rendering::SurfaceKind::implicit)) {
      continue;
    }
    for (const CutLine& line :
         cut_lines(object.mesh, [&view](const Vec3& p_W) { return view.toward(p_W); })) {
      const PlanePoint a = view.point(line[0]);
      const PlanePoint b = view.point(line[1]);
      const auto is_beside = [](double from, double to, double low, double high) {
        return std::max(from, to) < low || std::min(from, to) > high;
      };
      if (!is_beside(a.right, b.right, window.lower.right, window.upper.right) &&
          !is_beside(a.up, b.up, window.lower.up, window.upper.up)) {
        block.add_point(a);
        block.add_point(b);
        block.lift_pen();
      }
    }
  }
  return block.finish();
}

// Returns the lines of the planes of one fate: where the constraint on the tool's centre begins.
std::string planes_block(const std::string& name, const TickSteps& tick, const TickView& view,
                         const Window& window, bool active) {
  Block block(name);
  for (const StepMove& move : tick.moves) {
    for (const StepPlane& plane : move.planes) {
      const PlanePoint normal = view.direction(plane.normal_W);
      const double length = std::hypot(normal.right, normal.up);
      // A plane that lies nearly in the picture has no line in it.
      constexpr double kEdgeOn = 0.05;
      if ((plane.fate == "active") != active || length < kEdgeOn) {
        continue;
      }
      const PlanePoint at = view.point(move.from_W);
      const double reach = 2.0 * window.width() / length;
      block.add(at.right - reach * normal.up, at.up + reach * normal.right);
      block.add(at.right + reach * normal.up, at.up - reach * normal.right);
      block.lift_pen();
    }
  }
  return block.finish();
}

// Returns the moves as arrows, and their sub-goals where a move did not arrive.
std::string moves_blocks(const std::string& suffix, const TickSteps& tick, const TickView& view) {
  Block moves("moves_" + suffix);
  Block goals("goals_" + suffix);
  Block missed("missed_" + suffix);
  for (const StepMove& move : tick.moves) {
    const PlanePoint from = view.point(move.from_W);
    const PlanePoint to = view.point(move.to_W);
    const PlanePoint goal = view.point(move.goal_W);
    if (move.from_W != move.to_W) {
      moves.add(from.right, from.up, to.right - from.right, to.up - from.up);
    }
    if (move.ending != "arrived" && move.ending != "settled") {
      goals.add_point(goal);
      missed.add(to.right, to.up, goal.right - to.right, goal.up - to.up);
    }
  }
  return moves.finish() + goals.finish() + missed.finish();
}

// Returns the tool, the proxy before and after with the tool's radius, the point under the proxy,
// and the spring between tool and proxy.
std::string places_blocks(const std::string& suffix, const TickSteps& tick, const TickView& view) {
  Block tool("tool_" + suffix);
  tool.add_point(view.point(tick.tool_W));
  Block before("before_" + suffix);
  before.add_point(view.point(tick.from_W));
  Block proxy("proxy_" + suffix);
  proxy.add_point(view.point(tick.proxy_W));
  Block ball("ball_" + suffix);
  const PlanePoint centre = view.point(tick.proxy_W);
  ball.add(centre.right, centre.up, 1e3 * tool_radius_m(tick));
  Block under("under_" + suffix);
  if (tick.surface_W) {
    under.add_point(view.point(*tick.surface_W));
  }
  Block spring("spring_" + suffix);
  spring.add_point(view.point(tick.tool_W));
  spring.add_point(centre);
  spring.lift_pen();
  return tool.finish() + before.finish() + proxy.finish() + ball.finish() + under.finish() +
         spring.finish();
}

// Returns the cones from the tool to the plane without friction, and from above their circles.
std::string cone_blocks(const TickPanel& panel) {
  constexpr int kPoints = 180;
  Block static_block("static_" + panel.suffix);
  Block dynamic_block("dynamic_" + panel.suffix);
  if (const auto circles = circles_of(panel.tick)) {
    const PlanePoint tip = panel.view.point(panel.tick.tool_W);
    const PlanePoint centre = panel.view.point(without_friction_W(panel.tick));
    const auto add = [&](Block& block, double r_mm) {
      if (!panel.from_above) {
        block.add(centre.right - r_mm, centre.up);
        block.add_point(tip);
        block.add(centre.right + r_mm, centre.up);
      }
      for (int i = 0; panel.from_above && i <= kPoints; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / kPoints;
        block.add(centre.right + r_mm * std::cos(angle), centre.up + r_mm * std::sin(angle));
      }
      block.lift_pen();
    };
    add(static_block, 1e3 * circles->first);
    add(dynamic_block, 1e3 * circles->second);
  }
  return static_block.finish() + dynamic_block.finish();
}

// Returns the numbers of the moves at their ends; of ends that are close to each other, the first.
std::string numbers_block(const TickPanel& panel) {
  constexpr double kTogether = 0.05;
  std::string block = fmt::format("$numbers_{} << EOD\n1e9 1e9 \"\"\n", panel.suffix);
  std::vector<PlanePoint> written;
  for (std::size_t i = 0; panel.has_numbers && i < panel.tick.moves.size(); ++i) {
    const StepMove& move = panel.tick.moves[i];
    const PlanePoint at = panel.view.point(move.to_W);
    const bool is_close = std::ranges::any_of(written, [&](const PlanePoint& other) {
      return std::hypot(at.right - other.right, at.up - other.up) <
             kTogether * panel.window.width();
    });
    if (move.from_W != move.to_W && !is_close) {
      written.push_back(at);
      fmt::format_to(std::back_inserter(block), "{:.7g} {:.7g} \"{}\"\n", at.right, at.up, i + 1);
    }
  }
  return block + "EOD\n";
}

std::string_view state_name(int number) {
  return rendering::kFrictionNames.at(static_cast<std::size_t>(std::clamp(number, 0, 2)));
}

// Returns the line of facts of a tick on a formula: how its iterations ended, and on which side of
// the last tangent plane the tool is, which keeps the contact or breaks it.
std::string formula_facts(const TickSteps& tick) {
  std::string endings;
  std::optional<double> tool_m;
  std::size_t count = 0;
  std::size_t alike = 0;
  for (std::size_t i = 0; i < tick.moves.size(); ++i) {
    const StepMove& move = tick.moves[i];
    if (!move.formula) {
      continue;
    }
    ++count;
    ++alike;
    if (const auto& normal_W = move.formula->normal_W) {
      tool_m = normal_W->dot(tick.tool_W - move.from_W);
    }
    if (i + 1 == tick.moves.size() || tick.moves[i + 1].ending != move.ending) {
      endings += endings.empty() ? "" : ", ";
      endings += alike == 1 ? move.ending : fmt::format("{} {}", alike, move.ending);
      alike = 0;
    }
  }
  std::string facts = fmt::format("{} iteration{}: {}", count, count == 1 ? "" : "s", endings);
  if (tool_m) {
    facts += fmt::format("; tool {:.4g} mm {} the last tangent plane: {}", 1e3 * std::abs(*tool_m),
                         *tool_m < 0.0 ? "behind" : "in front of",
                         tick.normal_W ? "contact" : "no contact");
  }
  return tick.normal_W ? facts + fmt::format(", friction {} → {}", state_name(tick.friction_before),
                                             state_name(tick.friction))
                       : facts;
}

}  // namespace

std::string tick_panel(const TickPanel& panel, std::span<const rendering::Object> objects,
                       const PictureSize& sheet) {
  const std::string& suffix = panel.suffix;
  std::string script = cone_blocks(panel) + cut_block(panel, objects);
  // The view from above leaves out the surface and the planes, which would hide the moves.
  for (const bool active : {true, false}) {
    const std::string name = (active ? "held_" : "loose_") + suffix;
    script += panel.from_above ? Block(name).finish()
                               : planes_block(name, panel.tick, panel.view, panel.window, active);
  }
  script += moves_blocks(suffix, panel.tick, panel.view) +
            places_blocks(suffix, panel.tick, panel.view) + numbers_block(panel);
  script += panel.field != nullptr ? panel.field->head : "";
  const PanelPlace& place = panel.place;
  return script + fmt::format(kTickView, fmt::arg("left", place.left / sheet.width_px),
                              fmt::arg("right", (place.left + place.width) / sheet.width_px),
                              fmt::arg("bottom", place.bottom / sheet.height_px),
                              fmt::arg("top", (place.bottom + place.height) / sheet.height_px),
                              fmt::arg("x0", panel.window.lower.right),
                              fmt::arg("x1", panel.window.upper.right),
                              fmt::arg("y0", panel.window.lower.up),
                              fmt::arg("y1", panel.window.upper.up),
                              fmt::arg("xlabel", gnuplot_string(panel.x_label)),
                              fmt::arg("ylabel", gnuplot_string(panel.y_label)),
                              fmt::arg("title", gnuplot_string(panel.title)),
                              fmt::arg("behind", panel.field != nullptr ? panel.field->items : ""),
                              fmt::arg("s", suffix));
}

// Returns one line of what the picture cannot show.
std::string facts_of(const TickSteps& tick) {
  if (formula_of({&tick, 1})) {
    return formula_facts(tick);
  }
  const auto moves = std::ranges::count_if(
      tick.moves, [](const StepMove& move) { return move.from_W != move.to_W; });
  std::string facts = fmt::format("{} move{}", moves, moves == 1 ? "" : "s");
  if (!tick.normal_W) {
    return facts + ", no contact";
  }
  facts += fmt::format(", depth {:.4g} mm, friction {} → {}", 1e3 * tick.depth_m,
                       state_name(tick.friction_before), state_name(tick.friction));
  if (const auto circles = circles_of(tick)) {
    facts +=
        fmt::format(", circles {:.4g} and {:.4g} mm", 1e3 * circles->first, 1e3 * circles->second);
  }
  std::string multipliers;
  if (!tick.moves.empty()) {
    for (const StepPlane& plane : tick.moves.back().planes) {
      if (plane.multiplier_m > 0.0) {
        multipliers +=
            fmt::format("{}{:.4g}", multipliers.empty() ? "" : ", ", 1e3 * plane.multiplier_m);
      }
    }
  }
  return multipliers.empty() ? facts : facts + fmt::format(", multipliers {} mm", multipliers);
}

}  // namespace tactus::host
