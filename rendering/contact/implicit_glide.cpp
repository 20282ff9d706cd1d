#include "rendering/contact/implicit_glide.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

namespace tactus::rendering {
namespace {

// The tangent plane: `along` toward the goal, `across` beside it.
struct Tangents {
  Vec3 along;
  Vec3 across;
};

using Mat2 = Eigen::Matrix2d;
using Vec2 = Eigen::Vector2d;

// How the normal turns along the tangents, 1 per unit of length; positive on a bulge. Differences
// of normals, not of gradients: beside a singular point the gradient's size says nothing. A guess
// is good enough here, every step is checked before it is taken.
Mat2 shape_operator(ImplicitField& field, const ImplicitSample& at, const Tangents& t,
                    double distance) {
  const Vec3 along = sample(field, at.point + distance * t.along).normal - at.normal;
  const Vec3 across = sample(field, at.point + distance * t.across).normal - at.normal;
  const double twist = 0.5 * (along.dot(t.across) + across.dot(t.along));
  Mat2 shape;
  shape << along.dot(t.along), twist, twist, across.dot(t.across);
  return shape / distance;
}

// The tangent step (1 - depth * S)^-1 (length, 0), shortened to turn the normal by no more than the
// second order can be trusted with. Where the tool lies beyond the centre of curvature that is no
// minimum: then as far along the plain step as the normal's turn lets it go.
Vec2 corrected_step(const Mat2& shape, double depth, double length) {
  constexpr double kMostTurn_rad = 0.3;
  constexpr double kMostStretch = 1e3;
  constexpr double kLeastStiffness = 1.0 / kMostStretch;
  const Mat2 stiffness = Mat2::Identity() - depth * shape;
  const double determinant = stiffness.determinant();
  Vec2 step{kMostStretch * length, 0.0};
  if (stiffness.trace() > 0.0 && determinant > kLeastStiffness) {
    step = length / determinant * Vec2{stiffness(1, 1), -stiffness(1, 0)};
  }
  const double turn = (shape * step).norm();
  return turn > kMostTurn_rad ? Vec2{kMostTurn_rad / turn * step} : step;
}

// Returns true if a path between two surface points is free. The straight segment dips into a
// bulge, so the path has an apex above the middle, high enough that F certainly climbs on the first
// half and falls on the second. One interval each then mostly proves the path free.
bool is_path_free(ImplicitField& field, const ImplicitSample& from, const ImplicitSample& to) {
  constexpr std::size_t kMostRanges = 8;
  constexpr double kLeastSlope = 0.05;
  const Vec3 chord = to.point - from.point;
  const double length = chord.norm();
  const double turn = (to.normal - from.normal).dot(chord) / length;  // curvature * length
  const double rise = length * (kLeastSlope + 0.5 * std::abs(turn) + 0.25 * turn);
  const Vec3 apex = 0.5 * (from.point + to.point) + rise * (from.normal + to.normal).normalized();
  return field.surface().bounds_O.contains(apex) &&
         first_crossing(field, from.point, apex, kMostRanges).state == SegmentState::free &&
         first_crossing(field, apex, to.point, kMostRanges).state == SegmentState::free;
}

bool is_better(const ImplicitSample& from, const ImplicitSample& to, const Vec3& tool) {
  constexpr double kMostTurn_cos = 0.5;
  // Within their resting height the two may differ without being further.
  const double lift = std::abs(to.height - from.height);
  return to.value >= 0.0 && to.normal.dot(from.normal) > kMostTurn_cos &&
         (to.point - tool).norm() - lift < (from.point - tool).norm();
}

}  // namespace

std::optional<ImplicitSample> glide(ImplicitField& field, const GlideStart& start) {
  constexpr int kMostTries = 3;
  constexpr double kShorter = 0.25;
  constexpr double kLeastProbe_m = 1e-6;
  constexpr double kMostProbe_m = 1e-4;
  const double scale_m = field.surface().scale_m;
  const ImplicitSample& from = start.from;
  const Vec3 wanted = start.goal - from.point;
  const Vec3 tangent = wanted - from.normal.dot(wanted) * from.normal;
  const double length = tangent.norm();
  if (!(length > 0.0) || !(from.steepness > 0.0)) {
    return std::nullopt;
  }
  Tangents t{.along = tangent / length, .across = {}};
  t.across = from.normal.cross(t.along);
  const double probe = std::clamp(0.5 * length, kLeastProbe_m / scale_m, kMostProbe_m / scale_m);
  const Mat2 shape = shape_operator(field, from, t, probe);
  const double depth = from.normal.dot(from.point - start.tool);
  Vec2 step = corrected_step(shape, depth, length);
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
