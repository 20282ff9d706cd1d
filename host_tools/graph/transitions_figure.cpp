// The figure is in pixels: four circles in a square, an arc from circle to circle for each change,
// bent to the right of its direction so that there and back are two, and a loop for staying.
#include "host_tools/graph/transitions_figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <iterator>
#include <numbers>
#include <string_view>
#include <vector>

#include "host_tools/graph/graph_colours.h"
#include "host_tools/plot/gnuplot.h"
#include "host_tools/plot/silhouette.h"

namespace tactus::host {
namespace {

constexpr double kStatesWidth = 1300.0;
constexpr double kStatesHeight = 1040.0;
constexpr double kStateRadius = 92.0;

constexpr std::array<PlanePoint, kContactStates> kStatePlaces = {
    PlanePoint{.right = 370.0, .up = 740.0}, PlanePoint{.right = 930.0, .up = 740.0},
    PlanePoint{.right = 930.0, .up = 270.0}, PlanePoint{.right = 370.0, .up = 270.0}};
constexpr std::array<std::string_view, kContactStates> kStateColours = {
    kGraphGrey, kGraphBlue, kGraphOrange, kGraphVermilion};

PlanePoint operator+(const PlanePoint& a, const PlanePoint& b) {
  return {.right = a.right + b.right, .up = a.up + b.up};
}
PlanePoint operator-(const PlanePoint& a, const PlanePoint& b) {
  return {.right = a.right - b.right, .up = a.up - b.up};
}
PlanePoint operator*(double s, const PlanePoint& a) {
  return {.right = s * a.right, .up = s * a.up};
}
PlanePoint unit(const PlanePoint& a) {
  return 1.0 / std::hypot(a.right, a.up) * a;
}
PlanePoint right_of(const PlanePoint& direction) {
  return {.right = direction.up, .up = -direction.right};
}
PlanePoint turned(const PlanePoint& a, double angle) {
  return std::cos(angle) * a + -std::sin(angle) * right_of(a);
}

// A cubic curve (Bezier's).
struct StateArc {
  std::array<PlanePoint, 4> points;

  [[nodiscard]] PlanePoint at(double t) const {
    const double u = 1.0 - t;
    return u * u * u * points[0] + 3.0 * u * u * t * points[1] + 3.0 * u * t * t * points[2] +
           t * t * t * points[3];
  }
};

// Returns the arc of a change, from rim to rim.
StateArc arc_between(std::size_t from, std::size_t to) {
  constexpr double kTurn = 0.24;  // rad, off the straight line between the middles
  const PlanePoint along = unit(kStatePlaces[to] - kStatePlaces[from]);
  const PlanePoint start = turned(along, -kTurn);
  const PlanePoint end = turned(-1.0 * along, kTurn);
  const PlanePoint first = kStatePlaces[from] + kStateRadius * start;
  const PlanePoint last = kStatePlaces[to] + kStateRadius * end;
  const double reach = std::hypot((last - first).right, (last - first).up) / 3.0;
  return {{first, first + reach * start, last + reach * end, last}};
}

// Returns the direction away from the middle of the figure.
PlanePoint outward(std::size_t state) {
  return unit(kStatePlaces[state] - PlanePoint{.right = 650.0, .up = 505.0});
}

StateArc loop_of(std::size_t state) {
  constexpr double kHalfAngle = 0.42;
  constexpr double kReach = 130.0;
  const PlanePoint start = turned(outward(state), kHalfAngle);
  const PlanePoint end = turned(outward(state), -kHalfAngle);
  const PlanePoint first = kStatePlaces[state] + kStateRadius * start;
  const PlanePoint last = kStatePlaces[state] + kStateRadius * end;
  return {{first, first + kReach * start, last + kReach * end, last}};
}

// The data blocks, the labels and the parts of the command `plot`.
struct StateScript {
  std::string blocks;
  std::string labels;
  std::string plots;
  int count = 0;

  void add(const std::vector<PlanePoint>& points, const std::string& style) {
    fmt::format_to(std::back_inserter(blocks), "$state{} << EOD\n", count);
    for (const PlanePoint& p : points) {
      fmt::format_to(std::back_inserter(blocks), "{:.5g} {:.5g}\n", p.right, p.up);
    }
    blocks += "EOD\n";
    fmt::format_to(std::back_inserter(plots), ", \\\n  $state{} {}", count++, style);
  }

  // Adds a text of one line or more about a point.
  void add_label(const PlanePoint& p, std::initializer_list<std::string_view> lines,
                 std::string_view look) {
    constexpr double kLineHeight = 22.0;
    double up = p.up + 0.5 * kLineHeight * (static_cast<double>(lines.size()) - 1.0);
    for (const std::string_view line : lines) {
      fmt::format_to(std::back_inserter(labels),
                     "set label {} at first {:.5g},{:.5g} {} front noenhanced\n",
                     gnuplot_string(line), p.right, up, look);
      up -= kLineHeight;
    }
  }

  // Adds an arc with its head; `width` is in pixels.
  void add_arrow(const StateArc& arc, double width, std::string_view colour) {
    constexpr int kSteps = 40;
    const double length = 12.0 + 2.5 * width;
    const PlanePoint tip = arc.points[3];
    const PlanePoint back = tip + length * unit(arc.points[2] - tip);
    const PlanePoint side = (3.0 + 1.3 * width) * right_of(unit(tip - back));
    std::vector<PlanePoint> line;
    for (int i = 0; i <= kSteps; ++i) {
      const PlanePoint p = arc.at(static_cast<double>(i) / kSteps);
      if (std::hypot((p - tip).right, (p - tip).up) > 0.8 * length) {
        line.push_back(p);
      }
    }
    add(line, fmt::format("with lines linecolor \"{}\" linewidth {:.3g}", colour, width));
    add({tip, back + side, back - side, tip},
        fmt::format("with filledcurves closed linecolor \"{}\" fillstyle solid noborder", colour));
  }
};

void add_changes(StateScript& script, const Transitions& transitions, std::size_t from,
                 double log_most) {
  for (std::size_t to = 0; to < kContactStates; ++to) {
    const std::size_t number = transitions.counts[from][to];
    if (number == 0) {
      continue;
    }
    const double width =
        1.0 + 5.0 * std::log1p(static_cast<double>(number)) / std::max(log_most, 1.0);
    const StateArc arc = from == to ? loop_of(from) : arc_between(from, to);
    script.add_arrow(arc, width, kStateColours[from]);
    if (from == to) {
      const PlanePoint p = kStatePlaces[from] + (kStateRadius + 112.0) * outward(from);
      const std::string_view look = outward(from).right < 0.0 ? "right" : "left";
      const std::string stays = fmt::format("{} stay", number);
      const std::size_t another = transitions.to_another[from];
      if (another == 0) {
        script.add_label(p, {stays}, look);
      } else {
        script.add_label(p,
                         {stays, fmt::format("{} of them to", another),
                          fmt::format("another {}", kStateNames[from])},
                         look);
      }
    } else {
      // The diagonals cross in their middle, so a number stands near where its arrow begins.
      const double t = (from + to) % 2 == 0 ? 0.27 : 0.5;
      const PlanePoint along = unit(kStatePlaces[to] - kStatePlaces[from]);
      script.add_label(arc.at(t) + (14.0 + width) * right_of(along), {fmt::format("{}", number)},
                       "center");
    }
  }
}

void add_states(StateScript& script, const Transitions& transitions) {
  for (std::size_t state = 0; state < kContactStates; ++state) {
    std::vector<PlanePoint> rim;
    constexpr int kRimPoints = 72;
    for (int i = 0; i <= kRimPoints; ++i) {
      rim.push_back(kStatePlaces[state] +
                    kStateRadius *
                        turned({.right = 1.0, .up = 0.0}, 2.0 * std::numbers::pi * i / kRimPoints));
    }
    script.add(rim, "with filledcurves closed linecolor \"#f4f4f4\" fillstyle solid noborder");
    script.add(rim, fmt::format("with lines linecolor \"{}\" linewidth 3", kStateColours[state]));
    const double share = 100.0 * static_cast<double>(transitions.ticks_in[state]) /
                         static_cast<double>(std::max<std::size_t>(transitions.ticks, 1));
    script.add_label(kStatePlaces[state] + PlanePoint{.right = 0.0, .up = 22.0},
                     {kStateNames[state]}, "center font \",19\"");
    script.add_label(
        kStatePlaces[state] - PlanePoint{.right = 0.0, .up = 20.0},
        {fmt::format("{} ticks", transitions.ticks_in[state]), fmt::format("{:.1f} %", share)},
        R"(center font ",13" textcolor "#333333")");
  }
}

constexpr std::string_view kStatesFrame = R"gnuplot(
unset border
unset tics
unset key
set lmargin at screen 0
set rmargin at screen 1
set bmargin at screen 0
set tmargin at screen 1
set xrange [0:{width}]
set yrange [0:{height}]
)gnuplot";

}  // namespace

void draw_transitions(const Transitions& transitions, const std::string& title,
                      const std::filesystem::path& picture) {
  std::size_t most = 0;
  for (const auto& row : transitions.counts) {
    most = std::max(most, *std::ranges::max_element(row));
  }
  StateScript script;
  for (std::size_t from = 0; from < kContactStates; ++from) {
    add_changes(script, transitions, from, std::log1p(static_cast<double>(most)));
  }
  add_states(script, transitions);
  script.add_label({.right = 40.0, .up = kStatesHeight - 40.0}, {title}, "left font \",18\"");
  script.add_label(
      {.right = 40.0, .up = 36.0},
      {fmt::format("{} changes of state in {} ticks, {} of object. An arrow's width "
                   "grows with the logarithm of its number.",
                   transitions.changes(), transitions.ticks, transitions.object_changes)},
      "left textcolor \"#555555\"");
  const GnuplotFolder folder;
  run_gnuplot(folder, {.width_px = kStatesWidth, .height_px = kStatesHeight},
              script.blocks +
                  fmt::format(kStatesFrame, fmt::arg("width", kStatesWidth),
                              fmt::arg("height", kStatesHeight)) +
                  script.labels + "plot 1e9 notitle" + script.plots + "\n",
              picture);
}

}  // namespace tactus::host
