// The step of a proxy p that rests on a smooth surface, toward the tool h.
//
// Near p the surface is z(s) = -1/2 s . S s over its tangent plane, where s is the tangent step, z
// the height along the normal n and S the shape operator, positive on a bulge. The tool lies at the
// depth d > 0 below the end of the plain step u, which goes to its projection. The squared distance
// from the surface point to the tool is
//
//   |s - u|^2 + (d - 1/2 s . S s)^2
//
// Its gradient is zero, to first order in s, at (1 - d S) s = u. The plain step u takes S for 0 and
// leaves d times the curvature of the error: from 1 on it never settles in a hollow. The solved
// step is that of Newton's method, and its error falls quadratically.
//
// Friction is opposite to the motion, so a proxy that the friction circle holds back slides along
// the pull itself, also where the surface bends more to one side than to the other. With the pull
// q, the curvature k along it and the friction mu d, what is left of the pull falls along the path
// by 1 - k (d + mu q).
//
// The surface is not trusted beyond the second order: the step is cut to what the normal's turn
// permits, its end is brought back to the surface by Newton's method along the gradient, and the
// path must be proved free. A step that fails is tried again at a quarter of its length.
#include "rendering/contact/implicit_glide.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

#include "rendering/geometry/tangential.h"

namespace tactus::rendering {
namespace {

// Unit vectors in the tangent plane: `along` toward the goal, `across` beside it.
struct Tangents {
  Vec3 along;
  Vec3 across;
};

using Mat2 = Eigen::Matrix2d;
using Vec2 = Eigen::Vector2d;

// Returns the shape operator S in the basis of the tangents, 1 per unit of length, positive on a
// bulge: how the normal turns along them. It is measured at `distance` from `at`, at the cost of
// two evaluations. It takes differences of normals, not of gradients: beside a singular point the
// gradient's size says nothing. A guess is good enough here, every step is checked before it is
// taken.
Mat2 shape_operator(ImplicitField& field, const ImplicitSample& at, const Tangents& t,
                    double distance) {
  const auto near =
      two_samples(field, at.point + distance * t.along, at.point + distance * t.across);
  const Vec3 along = near[0].normal - at.normal;
  const Vec3 across = near[1].normal - at.normal;
  // S is symmetric; its two measured halves are not quite.
  const double twist = 0.5 * (along.dot(t.across) + across.dot(t.along));
  Mat2 shape;
  shape << along.dot(t.along), twist, twist, across.dot(t.across);
  return shape / distance;
}

// The pull on a proxy, along the tangent plane: its length, the part of it that the friction circle
// leaves, and the tool's depth below the plane.
struct Pull {
  double length = 0.0;
  double left = 0.0;
  double depth = 0.0;

  [[nodiscard]] bool is_held() const { return length > left; }
};

Pull pull_of(const GlideStart& start) {
  const Vec3& p = start.from.point;
  const Vec3& normal = start.from.normal;
  const double left = tangential(start.goal - p, normal).norm();
  return {.length =
              start.pulled_to == start.goal ? left : tangential(start.pulled_to - p, normal).norm(),
          .left = left,
          .depth = normal.dot(p - start.tool)};
}

// Returns the step along the pull that friction holds back: to the place where friction holds all
// of it, or short of there, since a proxy that goes too far does not come back. So on a bulge it
// leaves out that friction falls along the step. It is a long step if there is no such place ahead.
Vec2 step_along_pull(double curvature, const Pull& pull, double most_stretch) {
  const double friction =
      curvature < 0.0 ? (pull.length - pull.left) / pull.depth * pull.length : 0.0;
  const double stiffness = 1.0 - curvature * (pull.depth + friction);
  return {stiffness * most_stretch > 1.0 ? pull.left / stiffness : most_stretch * pull.left, 0.0};
}

// Returns the tangent step (1 - depth * S)^-1 (left, 0), or the one along the pull if friction
// holds the proxy back, cut so that the normal turns by at most 0.3 rad, as far as the second order
// is trusted. If the tool lies beyond the centre of curvature, where 1 - depth * S is not positive,
// the distance has no minimum nearby: the step then goes along the plain one as far as the normal's
// turn permits.
Vec2 corrected_step(const Mat2& shape, const Pull& pull) {
  constexpr double kMostTurn_rad = 0.3;
  constexpr double kMostStretch = 1e3;
  constexpr double kLeastStiffness = 1.0 / kMostStretch;
  const Mat2 stiffness = Mat2::Identity() - pull.depth * shape;
  const double determinant = stiffness.determinant();
  Vec2 step{kMostStretch * pull.left, 0.0};
  if (pull.is_held()) {
    step = step_along_pull(shape(0, 0), pull, kMostStretch);
  } else if (stiffness.trace() > 0.0 && determinant > kLeastStiffness) {
    step = pull.left / determinant * Vec2{stiffness(1, 1), -stiffness(1, 0)};
  }
  const double turn = (shape * step).norm();
  return turn > kMostTurn_rad ? Vec2{kMostTurn_rad / turn * step} : step;
}

// Returns true if the chord between two surface points is free. F is about the rest height at its
// ends, and the chord dips into a bulge by |turn| * length / 8. Intervals prove no more than a
// multiple of the dip, so the chord of a longer step is not tried.
bool is_chord_free(ImplicitField& field, const ImplicitSample& from, const ImplicitSample& to) {
  constexpr std::size_t kOneRange = 1;
  const Vec3 chord = to.point - from.point;
  const double bend = std::abs((to.normal - from.normal).dot(chord));  // |turn| * length
  return bend * field.surface().scale_m <= 2.0 * kImplicitRest_m &&
         first_crossing(field, from.point, to.point, kOneRange,
                        {.from = from.value, .to = to.value})
                 .state == SegmentState::free;
}

// Returns true if a path between two surface points is free: the chord of a short step; else a path
// with an apex above the middle of the chord, which dips into a bulge.
//
// Against the chord the surface's slope is at most |turn| / 2, at its ends. Each half of the path
// has the slope 2 rise / length = 0.1 + |turn| + turn / 2, which is steeper on a bulge (turn > 0)
// and in a hollow. So F certainly climbs on the first half and falls on the second, and one
// interval each mostly proves the path free.
bool is_path_free(ImplicitField& field, const ImplicitSample& from, const ImplicitSample& to) {
  constexpr std::size_t kMostRanges = 8;
  constexpr double kLeastSlope = 0.05;
  if (is_chord_free(field, from, to)) {
    return true;
  }
  const Vec3 chord = to.point - from.point;
  const double length = chord.norm();
  const double turn = (to.normal - from.normal).dot(chord) / length;  // curvature * length
  const double rise = length * (kLeastSlope + 0.5 * std::abs(turn) + 0.25 * turn);
  const Vec3 apex = 0.5 * (from.point + to.point) + rise * (from.normal + to.normal).normalized();
  return field.surface().bounds_O.contains(apex) &&
         first_crossing(field, from.point, apex, kMostRanges, {.from = from.value, .to = {}})
                 .state == SegmentState::free &&
         first_crossing(field, apex, to.point, kMostRanges, {.from = {}, .to = to.value}).state ==
             SegmentState::free;
}

// Returns true if the step's end is free, if its normal is within 60 degrees of the normal at the
// start, and if it is nearer to the tool.
bool is_better(const ImplicitSample& from, const ImplicitSample& to, const Vec3& tool) {
  constexpr double kMostTurn_cos = 0.5;
  // The heights differ by what settling leaves; that must not count as farther.
  const double lift = std::abs(to.height - from.height);
  return to.value >= 0.0 && to.normal.dot(from.normal) > kMostTurn_cos &&
         (to.point - tool).norm() - lift < (from.point - tool).norm();
}

}  // namespace

std::optional<ImplicitSample> glide(ImplicitField& field, const GlideStart& start) {
  // The normal is probed at half the step. Below a micrometre its differences are rounding; beyond
  // a tenth of a millimetre they say little of the surface at the proxy.
  constexpr int kMostTries = 3;
  constexpr double kShorter = 0.25;
  constexpr double kLeastProbe_m = 1e-6;
  constexpr double kMostProbe_m = 1e-4;
  const double scale_m = field.surface().scale_m;
  const ImplicitSample& from = start.from;
  const Pull pull = pull_of(start);
  if (!(pull.left > 0.0) || !(from.steepness > 0.0)) {
    return std::nullopt;
  }
  Tangents t{.along = tangential(start.goal - from.point, from.normal) / pull.left, .across = {}};
  t.across = from.normal.cross(t.along);
  const double probe = std::clamp(0.5 * pull.left, kLeastProbe_m / scale_m, kMostProbe_m / scale_m);
  const Mat2 shape = shape_operator(field, from, t, probe);
  Vec2 step = corrected_step(shape, pull);
  if (!step.allFinite()) {
    return std::nullopt;
  }
  for (int attempt = 0; attempt < kMostTries && field.can_evaluate(); ++attempt, step *= kShorter) {
    const Vec3 guess = from.point + step.x() * t.along + step.y() * t.across -
                       0.5 * step.dot(shape * step) * from.normal;
    const auto to = settle_at_rest(field, guess, step.norm() + kImplicitReach_m / scale_m);
    if (to && field.surface().bounds_O.contains(to->point) && is_better(from, *to, start.tool) &&
        is_path_free(field, from, *to)) {
      return to;
    }
  }
  return std::nullopt;
}

}  // namespace tactus::rendering
