// The clearance along the line, f(travel), is what keeps the sphere from the surface. Three shapes
// of f occur, and each has a root finder that never passes the first root:
//
// - outside a convex solid f is convex: Newton's method from the free side (as for triangles);
// - inside a convex skin f is concave: it stays positive between two positive values, and if the
//   end is negative the chord lies below f and the tangent at the far end above it, so that both
//   close in on the root;
// - round a torus f bends down no more than its curvatures allow: the step is the root of the
//   parabola that bends down as much as anything in reach can ("sphere tracing" of Hart, The Visual
//   Computer 12, 1996, with a second-order bound in place of the Lipschitz bound alone). Inside its
//   tube the parabola is that of the squared distance from the centre circle, which bends up by no
//   more than that from a straight line would.
//
// f is a signed distance, so |f'| <= 1 and a travel of f - inner is free in every case.
#include "rendering/contact/primitive_sweep.h"

#include <algorithm>
#include <cmath>

namespace tactus::rendering {
namespace {

// A descent below a nanometre a metre is the rounding of a move along a contact plane.
constexpr double kParallel = -1e-9;
// Newton's method and the chord take a handful; a grazing pass round a torus takes the most.
constexpr int kMostSweepSteps = 128;

// f and its derivative at one travel.
struct Clearance {
  double height = 0.0;  // m
  double slope = 0.0;   // per metre of travel
};

// f along one sweep. `side` is -1 inside a two-sided skin, so that f is above 0 where the sphere
// is.
class Line {
 public:
  Line(const Primitive& primitive, const Sweep& sweep, double side)
      : primitive_(primitive), sweep_(sweep), side_(side) {}

  // Return f at a travel, and f of a sample that was taken already.
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
  // Returns the tube's radius of a torus, m.
  [[nodiscard]] double tube_radius() const { return primitive_.dimensions_m[1]; }

 private:
  const Primitive& primitive_;
  const Sweep& sweep_;
  double side_;
};

// Newton's method for a convex f, as in sphere_sweep.cpp.
double outside_convex(const Line& line, const Clearance& start, double limit,
                      const ContactMargin& margin) {
  double travel = 0.0;
  Clearance now = start;
  for (int step = 0; step < kMostSweepSteps; ++step) {
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

// Returns a travel as near to the highest place of a concave f as it takes to be above `enough`.
// `low` is f at 0, where it rises, and `high` is f at `limit`.
double climb(const Line& line, Clearance low, double limit, Clearance high, double enough) {
  double from = 0.0;
  double to = limit;
  for (int step = 0; step < kMostSweepSteps && low.slope > high.slope; ++step) {
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

// Closes in on the root of a concave f from both sides. The chord from the free travel to the
// blocked one lies below f, so its root is free; the tangent at the blocked one lies above f, so
// its root is blocked unless rounding says otherwise. A sphere that starts within the margin may
// rise first.
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
  for (int step = 0; step < kMostSweepSteps && free_height > margin.stop_m; ++step) {
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

// Returns the longest step in which f certainly stays above `inner`, or the height over it if that
// is longer. The bound is the parabola above + slope t - bend t^2 / 2, with bend = 2 / radius: f
// bends down by at most one over the distance from the axis, and within half of that distance it at
// most doubles.
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

// Steps along a line round the outside of a torus. `leaving` says that the sphere starts inside the
// solid, which it may leave. `clear` is true once it has been clear of the contact margin, and only
// then does the surface block it again; a sphere that starts within the margin is blocked if it
// descends.
double round_torus(const Line& line, const Clearance& start, bool leaving, double limit,
                   const ContactMargin& margin) {
  const double least_step = margin.stop_m - margin.inner_m;
  double travel = 0.0;
  Clearance now = start;
  bool clear = !leaving && now.height > margin.inner_m;
  for (int step = 0; step < kMostSweepSteps; ++step) {
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

// Steps along a line inside the tube of a hollow torus. With D the distance from the centre circle,
// d = D at the start of a step and slope that of f, D^2 is at most d^2 - 2 d slope t + t^2; the
// step is the larger root of that parabola at the largest distance that the margin permits.
double inside_tube(const Line& line, const Clearance& start, double limit,
                   const ContactMargin& margin) {
  const double most = line.tube_radius() - margin.inner_m;  // from the centre circle
  double travel = 0.0;
  Clearance now = start;
  bool clear = now.height > margin.inner_m;
  for (int step = 0; step < kMostSweepSteps; ++step) {
    if ((!clear || now.height <= margin.stop_m) && now.slope < kParallel) {
      return travel;
    }
    const double distance = line.tube_radius() - now.height;
    const double to_nearest = distance * now.slope;
    const double beyond = to_nearest * to_nearest + (most - distance) * (most + distance);
    // From deep in the contact margin it moves no farther than to where it is nearest to the centre
    // circle.
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
