#include "host_tools/plot/tick_figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
#include <utility>

#include "host_tools/plot/gnuplot.h"
#include "host_tools/plot/silhouette.h"
#include "host_tools/plot/tick_script.h"
#include "host_tools/plot/tick_view.h"

namespace tactus::host {
namespace {

// The sheet, in pixels: two square panels side by side, a title above and a key below.
constexpr double kTickSheetWidth = 1800.0;
constexpr double kTickPanel = 760.0;
constexpr double kTickLeft = 100.0;
constexpr double kTickGap = 110.0;
constexpr double kTickBottom = 210.0;
constexpr double kTickTop = 110.0;
constexpr double kTickSheetHeight = kTickBottom + kTickPanel + kTickTop;

using Objects = std::span<const rendering::Object>;

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
std::string cut_block(const std::string& name, std::span<const rendering::Object> objects,
                      const TickView& view, const Window& window) {
  Block block(name);
  for (const rendering::Object& object : objects) {
    for (const rendering::TriangleIndices& triangle : object.mesh.triangles) {
      std::array<PlanePoint, 3> ends;
      std::size_t count = 0;
      for (std::size_t k = 0; k < 3 && count < 2; ++k) {
        const Vec3 a = rendering::to_vec3(object.mesh.vertices[triangle[k]]);
        const Vec3 b = rendering::to_vec3(object.mesh.vertices[triangle[(k + 1) % 3]]);
        const double from = view.toward(a);
        const double to = view.toward(b);
        if ((from < 0.0) != (to < 0.0)) {
          ends[count++] = view.point(a + from / (from - to) * (b - a));
        }
      }
      const auto is_beside = [&](double a, double b, double low, double high) {
        return std::max(a, b) < low || std::min(a, b) > high;
      };
      if (count == 2 &&
          !is_beside(ends[0].right, ends[1].right, window.lower.right, window.upper.right) &&
          !is_beside(ends[0].up, ends[1].up, window.lower.up, window.upper.up)) {
        block.add_point(ends[0]);
        block.add_point(ends[1]);
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
std::string cone_blocks(const TickSteps& tick, const TickView& across, const TickView& above) {
  Block static_cone("static_across");
  Block dynamic_cone("dynamic_across");
  Block static_circle("static_above");
  Block dynamic_circle("dynamic_above");
  if (const auto circles = circles_of(tick)) {
    const Vec3 centre_W = without_friction_W(tick);
    const PlanePoint tip = across.point(tick.tool_W);
    const PlanePoint centre = across.point(centre_W);
    const auto add_cone = [&](Block& block, double r_m) {
      block.add(centre.right - 1e3 * r_m, centre.up);
      block.add_point(tip);
      block.add(centre.right + 1e3 * r_m, centre.up);
      block.lift_pen();
    };
    const auto add_circle = [&](Block& block, double r_m) {
      constexpr int kPoints = 180;
      const PlanePoint middle = above.point(centre_W);
      for (int i = 0; i <= kPoints; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / kPoints;
        block.add(middle.right + 1e3 * r_m * std::cos(angle),
                  middle.up + 1e3 * r_m * std::sin(angle));
      }
      block.lift_pen();
    };
    add_cone(static_cone, circles->first);
    add_cone(dynamic_cone, circles->second);
    add_circle(static_circle, circles->first);
    add_circle(dynamic_circle, circles->second);
  }
  return static_cone.finish() + dynamic_cone.finish() + static_circle.finish() +
         dynamic_circle.finish();
}

// Returns the commands that draw one view; the second stands at the right.
std::string tick_view_script(const Window& window, bool from_above) {
  const double left = kTickLeft + (from_above ? kTickPanel + kTickGap : 0.0);
  return fmt::format(kTickView, fmt::arg("left", left / kTickSheetWidth),
                     fmt::arg("right", (left + kTickPanel) / kTickSheetWidth),
                     fmt::arg("bottom", kTickBottom / kTickSheetHeight),
                     fmt::arg("top", (kTickBottom + kTickPanel) / kTickSheetHeight),
                     fmt::arg("x0", window.lower.right), fmt::arg("x1", window.upper.right),
                     fmt::arg("y0", window.lower.up), fmt::arg("y1", window.upper.up),
                     fmt::arg("ylabel", from_above ? "'across it, seen from above (mm)'"
                                                   : "'along the contact normal (mm)'"),
                     fmt::arg("s", from_above ? "above" : "across"));
}

// Returns one line of what the picture cannot show.
std::string facts_of(const TickSteps& tick) {
  constexpr std::array<std::string_view, 3> kStates{"free", "stick", "slip"};
  const auto state = [&](int number) {
    return kStates.at(static_cast<std::size_t>(std::clamp(number, 0, 2)));
  };
  const auto moves = std::ranges::count_if(
      tick.moves, [](const StepMove& move) { return move.from_W != move.to_W; });
  std::string facts = fmt::format("{} move{}", moves, moves == 1 ? "" : "s");
  if (!tick.normal_W) {
    return facts + ", no contact";
  }
  facts += fmt::format(", depth {:.4g} mm, friction {} → {}", 1e3 * tick.depth_m,
                       state(tick.friction_before), state(tick.friction));
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

}  // namespace

void draw_tick_figure(const TickSteps& tick, std::span<const rendering::Object> objects,
                      const std::string& title, const std::filesystem::path& picture) {
  const TickView across(tick, false);
  const TickView above(tick, true);
  const TemporaryFolder folder;
  std::string script = cone_blocks(tick, across, above);
  for (const bool from_above : {false, true}) {
    const TickView& view = from_above ? above : across;
    const std::string suffix = from_above ? "above" : "across";
    const Window window = view.window(tick);
    // The view from above leaves out the surface and the planes, which would hide the moves.
    script += cut_block("cut_" + suffix, from_above ? Objects{} : objects, view, window);
    for (const bool active : {true, false}) {
      const std::string name = (active ? "held_" : "loose_") + suffix;
      script += from_above ? Block(name).finish() : planes_block(name, tick, view, window, active);
    }
    script += moves_blocks(suffix, tick, view);
    script += places_blocks(suffix, tick, view);
  }
  script += fmt::format(kTickHead, fmt::arg("title", gnuplot_string(title)),
                        fmt::arg("facts", gnuplot_string(facts_of(tick))),
                        fmt::arg("left", kTickLeft / kTickSheetWidth),
                        fmt::arg("title_y", 1.0 - 32.0 / kTickSheetHeight),
                        fmt::arg("facts_y", 1.0 - 66.0 / kTickSheetHeight));
  script += tick_view_script(across.window(tick), false);
  script += tick_view_script(above.window(tick), true);
  script += fmt::format(kTickKey, fmt::arg("top", (kTickBottom - 85.0) / kTickSheetHeight));
  run_gnuplot(folder, {.width_px = kTickSheetWidth, .height_px = kTickSheetHeight}, script,
              picture);
}

}  // namespace tactus::host
