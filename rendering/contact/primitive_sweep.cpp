// The clearance along the line, f(travel), is what keeps the sphere from the surface. Three shapes
// of f occur, and each has a root finder that never passes the first root:
//
// - outside a convex solid f is convex: Newton's method from the free side (as for triangles);
// - inside a convex skin f is concave: it stays positive between two positive values, and where the
//   end is negative the chord lies below f and the tangent at the far end above it, so that both
//   close in on the root;
// - round a torus f bends down no more than its curvatures allow: the step is the root of the
//   parabola that bends down as much as anything in reach can ("sphere tracing" of Hart, The Visual
//   Computer 12, 1996, with a second-order bound in place of the Lipschitz bound alone). Inside its
//   tube the parabola is that of the squared distance from the centre circle, which bends up by no
//   more than that from a straight line would.
#include "rendering/contact/primitive_sweep.h"

#include <algorithm>
#include <cmath>

namespace tactus::rendering {
namespace {

// A descent below a nanometre a metre is the rounding of a move along a contact plane.
constexpr double kParallel = -1e-9;
// Newton's method and the chord take a handful; a grazing pass round a torus takes the most.
constexpr int kMostSteps = 128;

struct Clearance {
  double height = 0.0;  // m
  double slope = 0.0;   // per metre of travel
};

class Line {
 public:
  Line(const Primitive& primitive, const Sweep& sweep, double side)
      : primitive_(primitive), sweep_(sweep), side_(side) {}

  [[nodiscard]] Clearance at(double travel) const {
    return of(sample(primitive_, sweep_.from + travel * sweep_.direction));
  }
  [[nodiscard]] Clearance of(const SurfaceSample& seen) const {
    return {.height = side_ * seen.distance_m,
            .slope = side_ * seen.normal_W.dot(sweep_.direction)};
  }

  // The torus alone: outside its tube the clearance bends down by at most one over this, the
  // distance from the axis.
  [[nodiscard]] double bend_radius(double travel) const {
    const Vec3 p = primitive_.X_WO.point_in(sweep_.from + travel * sweep_.direction);
    return std::sqrt(p.x() * p.x() + p.z() * p.z());
  }
  [[nodiscard]] double tube_radius() const { return primitive_.dimensions_m[1]; }

 private:
  const Primitive& primitive_;
  const Sweep& sweep_;
  double side_;
};

double outside_convex(const Line& line, const Clearance& start, double limit,
                      const ContactMargin& margin) {
  double travel = 0.0;
  Clearance now = start;
  for (int step = 0; step < kMostSteps; ++step) {
    if (now.slope >= kParallel) {
      return limit;
    }
    travel += std::max(0.0, now.height - margin.inner_m) / -now.slope;
    if (travel >= limit) {
      return limit;
    }
    now = line.at(travel);
    if (now.height <= margin.stop_m) {
      const bool has_passed = now.height >= margin.inner_m && now.slope >= kParallel;
      return has_passed ? limit : travel;
    }
  }
  return travel;
}

// The travel, as near to the highest place of a concave f as it takes to be above `enough`.
double climb(const Line& line, Clearance low, double limit, Clearance high, double enough) {
  double from = 0.0;
  double to = limit;
  for (int step = 0; step < kMostSteps && low.slope > high.slope; ++step) {
    // f lies above both tangents, and so above the point where they meet.
    const double meet = ((high.height - high.slope * to) - (low.height - low.slope * from)) /
                        (low.slope - high.slope);
    const double travel = std::clamp(meet, from, to);
    const Clearance now = line.at(travel);
    if (now.height >= enough || travel <= from || travel >= to) {
      return now.height >= low.height ? travel : from;
    }
    if (now.slope > 0.0) {
      from = travel;
      low = now;
    } else {
      to = travel;
      high = now;
    }
  }
  return from;
}

double inside_convex(const Line& line, const Clearance& start, double limit,
                     const ContactMargin& margin) {
  Clearance end = line.at(limit);
  if (end.height >= std::min(start.height, margin.inner_m)) {
    return limit;
  }
  double free = 0.0;
  double free_height = start.height;
  if (start.height < margin.stop_m) {
    if (start.slope <= 0.0) {
      return 0.0;
    }
    free = climb(line, start, limit, end, margin.stop_m);
    free_height = line.at(free).height;
  }
  double beyond = limit;
  for (int step = 0; step < kMostSteps && free_height > margin.stop_m; ++step) {
    const double above = free_height - margin.inner_m;
    free += (beyond - free) * above / (above + (margin.inner_m - end.height));
    free_height = line.at(free).height;
    const double tangent = beyond + (margin.inner_m - end.height) / end.slope;
    if (tangent > free && tangent < beyond) {
      const Clearance there = line.at(tangent);
      if (there.height < margin.inner_m) {
        beyond = tangent;
        end = there;
      } else {
        free = tangent;
        free_height = there.height;
      }
    }
  }
  return free;
}

// The longest step in which f comes down to `inner`, or to where it is if that is lower, at its end
// at the earliest.
double torus_step(const Line& line, const Clearance& now, double travel,
                  const ContactMargin& margin) {
  const double above = std::max(0.0, now.height - margin.inner_m);
  const double radius = line.bend_radius(travel);
  if (!(radius > 0.0)) {
    return above;
  }
  const double bend = 2.0 / radius;  // within half the radius it at most doubles
  const double root = (now.slope + std::sqrt(now.slope * now.slope + 2.0 * bend * above)) / bend;
  return std::max(above, std::min(root, 0.5 * radius));
}

double round_torus(const Line& line, const Clearance& start, bool leaving, double limit,
                   const ContactMargin& margin) {
  const double least_step = margin.stop_m - margin.inner_m;
  double travel = 0.0;
  Clearance now = start;
  bool clear = !leaving && now.height > margin.inner_m;
  for (int step = 0; step < kMostSteps; ++step) {
    const bool stops = clear ? now.height <= margin.stop_m : !leaving;
    if (stops && now.slope < kParallel) {
      return travel;
    }
    if (clear) {
      travel += torus_step(line, now, travel, margin);
    } else if (leaving) {
      travel += std::max(margin.stop_m - now.height, least_step);
    } else {
      travel += std::max(torus_step(line, now, travel, margin), least_step);
    }
    if (travel >= limit) {
      return limit;
    }
    now = line.at(travel);
    clear = clear || now.height >= margin.stop_m;
  }
  return travel;
}

double inside_tube(const Line& line, const Clearance& start, double limit,
                   const ContactMargin& margin) {
  const double most = line.tube_radius() - margin.inner_m;  // from the centre circle
  double travel = 0.0;
  Clearance now = start;
  bool clear = now.height > margin.inner_m;
  for (int step = 0; step < kMostSteps; ++step) {
    if ((!clear || now.height <= margin.stop_m) && now.slope < kParallel) {
      return travel;
    }
    const double distance = line.tube_radius() - now.height;
    const double to_nearest = distance * now.slope;
    const double beyond = to_nearest * to_nearest + (most - distance) * (most + distance);
    // Deep in the contact margin no farther than to where it is nearest to the centre circle.
    travel += to_nearest + (clear ? std::sqrt(std::max(0.0, beyond)) : 0.0);
    if (travel >= limit) {
      return limit;
    }
    now = line.at(travel);
    clear = clear || now.height >= margin.stop_m;
  }
  return travel;
}

}  // namespace

double travel_to_contact(const Primitive& primitive, Sides sides, const Sweep& sweep, double limit,
                         const ContactMargin& margin, const SurfaceSample& start) {
  const bool inside = start.distance_m < 0.0;
  const bool solid = sides == Sides::one;
  const Line line(primitive, sweep, inside && !solid ? -1.0 : 1.0);
  const Clearance at_start = line.of(start);
  if (convex(primitive)) {
    if (inside && solid) {
      return limit;
    }
    return inside ? inside_convex(line, at_start, limit, margin)
                  : outside_convex(line, at_start, limit, margin);
  }
  return inside && !solid ? inside_tube(line, at_start, limit, margin)
                          : round_torus(line, at_start, inside, limit, margin);
}

}  // namespace tactus::rendering
