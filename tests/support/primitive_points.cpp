#include "tests/support/primitive_points.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace tactus::testing {
namespace {

using rendering::Primitive;
using rendering::PrimitiveKind;

constexpr double kFullCircle = 2.0 * std::numbers::pi;

// A surface of revolution about y from its profile (r, y) of v.
Patch turned(const std::function<Eigen::Vector2d(double)>& profile) {
  return [profile](double u, double v) {
    const Eigen::Vector2d ry = profile(v);
    return Vec3(ry.x() * std::cos(kFullCircle * u), ry.y(), ry.x() * std::sin(kFullCircle * u));
  };
}

Patch ring(double r0, double y0, double r1, double y1) {
  return turned([=](double v) { return Eigen::Vector2d(r0 + v * (r1 - r0), y0 + v * (y1 - y0)); });
}

// Part of a circle about (r, y), angles from +r toward +y.
Patch arc(double r, double y, double radius, double from, double to) {
  return turned([=](double v) {
    const double angle = from + v * (to - from);
    return Eigen::Vector2d(r + radius * std::cos(angle), y + radius * std::sin(angle));
  });
}

std::vector<Patch> box_faces(const Vec3& half) {
  std::vector<Patch> faces;
  for (Eigen::Index k = 0; k < 3; ++k) {
    for (const double side : {-1.0, 1.0}) {
      faces.emplace_back([=](double u, double v) {
        Vec3 p;
        p[k] = side * half[k];
        p[(k + 1) % 3] = (2.0 * u - 1.0) * half[(k + 1) % 3];
        p[(k + 2) % 3] = (2.0 * v - 1.0) * half[(k + 2) % 3];
        return p;
      });
    }
  }
  return faces;
}

std::vector<Patch> patches_in_O(const Primitive& primitive) {
  const double a = primitive.dimensions_m[0];
  const double b = primitive.dimensions_m[1];
  const double c = primitive.dimensions_m[2];
  constexpr double kQuarter = kFullCircle / 4.0;
  switch (primitive.kind) {
    case PrimitiveKind::plane:
      return {[](double u, double v) { return Vec3(u - 0.5, 0.0, v - 0.5); }};
    case PrimitiveKind::sphere:
      return {arc(0.0, 0.0, a, -kQuarter, kQuarter)};
    case PrimitiveKind::box:
      return box_faces({a, b, c});
    case PrimitiveKind::cylinder:
      return {ring(a, -b, a, b), ring(0.0, b, a, b), ring(0.0, -b, a, -b)};
    case PrimitiveKind::capsule:
      return {ring(a, -b, a, b), arc(0.0, b, a, 0.0, kQuarter), arc(0.0, -b, a, -kQuarter, 0.0)};
    case PrimitiveKind::cone:
      return {ring(0.0, 0.0, a, 0.0), ring(a, 0.0, 0.0, b)};
    case PrimitiveKind::torus:
      return {arc(a, 0.0, b, 0.0, kFullCircle)};
  }
  return {};
}

// Walks from (u, v) to better neighbours, with steps that halve where there is none. Along a slim
// cone a step of u is far shorter than one of v: some go mostly along one of them.
double descended(const Patch& patch, const Vec3& q, double u, double v) {
  constexpr std::array<std::array<double, 2>, 16> kNeighbours{{{-1, -1},
                                                               {0, -1},
                                                               {1, -1},
                                                               {-1, 0},
                                                               {1, 0},
                                                               {-1, 1},
                                                               {0, 1},
                                                               {1, 1},
                                                               {-0.1, -1},
                                                               {0.1, -1},
                                                               {-0.1, 1},
                                                               {0.1, 1},
                                                               {-1, -0.1},
                                                               {-1, 0.1},
                                                               {1, -0.1},
                                                               {1, 0.1}}};
  double best = (patch(u, v) - q).squaredNorm();
  for (double step = 0.05; step > 1e-10;) {
    bool better = false;
    for (const auto& [du, dv] : kNeighbours) {
      const double next_u = std::clamp(u + step * du, 0.0, 1.0);
      const double next_v = std::clamp(v + step * dv, 0.0, 1.0);
      const double squared = (patch(next_u, next_v) - q).squaredNorm();
      if (squared < best) {
        best = squared;
        u = next_u;
        v = next_v;
        better = true;
      }
    }
    step *= better ? 1.0 : 0.5;
  }
  return std::sqrt(best);
}

// Searches from starts all over the patch: at a pole every u is as good, so a single start can fail
// there.
double searched(const Patch& patch, const Vec3& q) {
  constexpr int kStarts = 6;
  double best = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kStarts; ++i) {
    for (int j = 0; j < kStarts; ++j) {
      best = std::min(best, descended(patch, q, (i + 0.5) / kStarts, (j + 0.5) / kStarts));
    }
  }
  return best;
}

Mat3 random_rotation(std::mt19937_64& random) {
  std::normal_distribution<double> bell;
  const Eigen::Quaterniond q(bell(random), bell(random), bell(random), bell(random));
  return q.normalized().toRotationMatrix();
}

}  // namespace

std::vector<Patch> patches(const Primitive& primitive) {
  std::vector<Patch> placed;
  for (const Patch& patch : patches_in_O(primitive)) {
    placed.emplace_back(
        [patch, X_WO = primitive.X_WO](double u, double v) { return X_WO.point(patch(u, v)); });
  }
  return placed;
}

double searched_distance(const std::vector<Patch>& surface, const Vec3& q) {
  double best = std::numeric_limits<double>::infinity();
  for (const Patch& patch : surface) {
    best = std::min(best, searched(patch, q));
  }
  return best;
}

bool inside(const Primitive& primitive, const Vec3& q_W) {
  const Vec3 q = primitive.X_WO.point_in(q_W);
  const double a = primitive.dimensions_m[0];
  const double b = primitive.dimensions_m[1];
  const double c = primitive.dimensions_m[2];
  const double rr = q.x() * q.x() + q.z() * q.z();
  switch (primitive.kind) {
    case PrimitiveKind::plane:
      return q.y() < 0.0;
    case PrimitiveKind::sphere:
      return q.squaredNorm() < a * a;
    case PrimitiveKind::box:
      return std::abs(q.x()) < a && std::abs(q.y()) < b && std::abs(q.z()) < c;
    case PrimitiveKind::cylinder:
      return rr < a * a && std::abs(q.y()) < b;
    case PrimitiveKind::capsule: {
      const double beyond = std::max(0.0, std::abs(q.y()) - b);
      return rr + beyond * beyond < a * a;
    }
    case PrimitiveKind::cone:
      return q.y() > 0.0 && q.y() < b && std::sqrt(rr) < a * (1.0 - q.y() / b);
    case PrimitiveKind::torus: {
      // The quartic (s + R^2 - r^2)^2 = 4 R^2 (x^2 + z^2).
      const double sum = q.squaredNorm() + a * a - b * b;
      return sum * sum < 4.0 * a * a * rr;
    }
  }
  return false;
}

Primitive random_primitive(PrimitiveKind kind, std::mt19937_64& random) {
  std::uniform_real_distribution<double> length(0.005, 0.05);
  std::uniform_real_distribution<double> place(-0.05, 0.05);
  Primitive primitive{.kind = kind};
  primitive.X_WO = {random_rotation(random), {place(random), place(random), place(random)}};
  primitive.dimensions_m = {length(random), length(random), length(random)};
  if (kind == PrimitiveKind::torus) {
    primitive.dimensions_m[1] = primitive.dimensions_m[0] * 18.0 * length(random);
  }
  return primitive;
}

}  // namespace tactus::testing
