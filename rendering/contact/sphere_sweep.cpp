// The distance from a point to a convex set is a convex function, so along a straight line it lies
// above each of its tangents. Newton's method on distance(travel) = inner,
//
//   travel += (distance - inner) / -(normal . direction)
//
// begun on the near side of the root, therefore never oversteps it: every iterate is a travel that
// is known to be free. It ends inside the contact margin, after one step over a face and
// quadratically on edges and vertices; if the steps run out (a grazing pass, where the root is
// double) the last iterate is a safe answer too. If the line comes no nearer than into the contact
// margin there is no root, and an iterate may lie behind the nearest place: it has passed. Faces,
// edges and vertices need no cases of their own.
//
// The normal from the nearest point is the gradient of the distance (geometry/triangle.h), so that
// normal . direction is its derivative along the sweep.
#include "rendering/contact/sphere_sweep.h"

#include <algorithm>

namespace tactus::rendering {

double travel_to_contact(const Triangle& triangle, bool one_sided, const Sweep& sweep, double limit,
                         const ContactMargin& margin, const Nearest& start) {
  constexpr int kMaxSteps = 32;
  // A descent below a nanometre a metre is the rounding of a move along a contact plane.
  constexpr double kParallelDescent = -1e-9;
  double travel = 0.0;
  Nearest at = start;
  if (one_sided) {
    // A sphere behind a one-sided triangle is blocked only if it comes to stand in front of it
    // clear of the contact margin. The sweep begins where its centre crosses the triangle's plane.
    const double height = triangle.height(sweep.from);
    if (height < 0.0) {
      const double rise = triangle.normal().dot(sweep.direction);
      travel = -height / rise;
      if (!(rise > 0.0) || travel >= limit) {
        return limit;
      }
      at = triangle.nearest(sweep.from + travel * sweep.direction);
      if (at.distance < margin.inner_m) {
        return limit;  // it comes out through the triangle: a direction that one-sided surfaces
                       // leave open
      }
    }
  }
  for (int step = 0; step < kMaxSteps; ++step) {
    const double descent = at.normal.dot(sweep.direction);
    // A convex distance that does not fall here rises from here on: the sweep has passed the
    // triangle.
    if (descent >= kParallelDescent) {
      return limit;
    }
    travel += std::max(0.0, at.distance - margin.inner_m) / -descent;
    if (travel >= limit) {
      return limit;
    }
    at = triangle.nearest(sweep.from + travel * sweep.direction);
    if (at.distance <= margin.stop_m) {
      const bool has_passed =
          at.distance >= margin.inner_m && at.normal.dot(sweep.direction) >= kParallelDescent;
      return has_passed ? limit : travel;
    }
  }
  return travel;
}

}  // namespace tactus::rendering
