#include "tests/property/closed_form.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace tactus::testing {
namespace {

using rendering::Primitive;
using rendering::PrimitiveDimensions;
using rendering::PrimitiveKind;

// The signed distance to a surface, below 0 inside, and the outward normal of the nearest point.
struct Measured {
  double distance_m = std::numeric_limits<double>::infinity();
  Vec3 normal = Vec3::Zero();
};

using Flat = Eigen::Vector2d;

// The nearest of several pieces of a border: the distance and the vector from it.
struct Border {
  double distance = std::numeric_limits<double>::infinity();
  Vec3 offset = Vec3::Zero();
  void take(const Vec3& away) {
    if (away.norm() < distance) {
      distance = away.norm();
      offset = away;
    }
  }
};

Measured about(const Vec3& core, double radius, const Vec3& p) {
  const Vec3 away = p - core;
  const double length = away.norm();
  return {length - radius, away / length};
}

Measured of_border(const Border& border, bool inside) {
  const double side = inside ? -1.0 : 1.0;
  return {side * border.distance, side / border.distance * border.offset};
}

Measured of_box(const Vec3& p, const Vec3& half) {
  Border border;
  for (Eigen::Index k = 0; k < 3; ++k) {
    for (const double side : {-1.0, 1.0}) {
      Vec3 nearest = p.cwiseMax(-half).cwiseMin(half);
      nearest[k] = side * half[k];
      border.take(p - nearest);
    }
  }
  return of_border(border, (p.cwiseAbs() - half).maxCoeff() < 0.0);
}

// A solid of revolution about y from the polygon of its section, from the axis to the axis,
// counter-clockwise with the solid on its left.
Measured of_polygon(const Vec3& p, const std::vector<Flat>& corners) {
  const Vec3 outward = Vec3(p.x(), 0.0, p.z()).normalized();
  const Flat q(std::hypot(p.x(), p.z()), p.y());
  Border border;
  bool inside = true;
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
    const Flat along = corners[i + 1] - corners[i];
    const Flat from = q - corners[i];
    const double t = std::clamp(from.dot(along) / along.squaredNorm(), 0.0, 1.0);
    const Flat away = from - t * along;
    border.take(away.x() * outward + away.y() * Vec3::UnitY());
    inside = inside && along.x() * from.y() - along.y() * from.x() > 0.0;
  }
  return of_border(border, inside);
}

// Measures in the primitive's frame.
Measured measure(PrimitiveKind kind, const PrimitiveDimensions& d, const Vec3& p) {
  switch (kind) {
    case PrimitiveKind::plane:
      return {p.y(), Vec3::UnitY()};
    case PrimitiveKind::sphere:
      return about(Vec3::Zero(), d[0], p);
    case PrimitiveKind::box:
      return of_box(p, {d[0], d[1], d[2]});
    case PrimitiveKind::cylinder:
      return of_polygon(p, {{0.0, -d[1]}, {d[0], -d[1]}, {d[0], d[1]}, {0.0, d[1]}});
    case PrimitiveKind::capsule:
      return about({0.0, std::clamp(p.y(), -d[1], d[1]), 0.0}, d[0], p);
    case PrimitiveKind::cone:
      return of_polygon(p, {{0.0, 0.0}, {d[0], 0.0}, {0.0, d[1]}});
    case PrimitiveKind::torus:
      return about(d[0] * Vec3(p.x(), 0.0, p.z()).normalized(), d[1], p);
  }
  return {};
}

// The room of the centre of a sphere of this radius within a solid has the same shape. Its base is
// `up` higher.
struct Room {
  PrimitiveDimensions dimensions_m{};
  double up_m = 0.0;
};

Room room_of(const Primitive& primitive, double radius_m) {
  const auto& [a, b, c] = primitive.dimensions_m;
  switch (primitive.kind) {
    case PrimitiveKind::box:
      return {{a - radius_m, b - radius_m, c - radius_m}};
    case PrimitiveKind::cylinder:
      return {{a - radius_m, b - radius_m}};
    case PrimitiveKind::cone: {
      const double tip = b - radius_m * std::hypot(a, b) / a;
      return {{(tip - radius_m) * a / b, tip - radius_m}, radius_m};
    }
    case PrimitiveKind::torus:
      return {{a, b - radius_m}};
    default:
      return {{a - radius_m, b, c}};
  }
}

}  // namespace

Clearance clearance(const TouchedShape& shape, const Vec3& p_W, double above_m) {
  const Primitive& primitive = shape.primitive;
  const Vec3 p = primitive.X_WO.point_in(p_W);
  const double radius_m = shape.tool_radius_m + above_m;
  if (shape.side == Side::outside || primitive.kind == PrimitiveKind::plane) {
    const double side = shape.side == Side::outside ? 1.0 : -1.0;
    const Measured seen = measure(primitive.kind, primitive.dimensions_m, p);
    return {side * seen.distance_m - radius_m, primitive.X_WO.direction(side * seen.normal)};
  }
  const Room room = room_of(primitive, radius_m);
  const Measured seen = measure(primitive.kind, room.dimensions_m, p - room.up_m * Vec3::UnitY());
  return {-seen.distance_m, primitive.X_WO.direction(-seen.normal)};
}

double reach(const TouchedShape& shape, const Vec3& p_W, double most_m) {
  constexpr double kSame_m = 1e-9;
  const Clearance here = clearance(shape, p_W, 0.0);
  const Vec3 place = p_W - here.distance_m * here.away_W;
  double low = 0.0;
  double high = most_m;
  for (int step = 0; step < 30; ++step) {
    const double depth = step == 0 ? most_m : 0.5 * (low + high);
    const bool same =
        clearance(shape, place - depth * here.away_W, 0.0).distance_m <= -depth + kSame_m;
    (same ? low : high) = depth;
    if (step == 0 && same) {
      break;
    }
  }
  return low;
}

Vec3 resting_place(const TouchedShape& shape, const Vec3& p_W, double above_m) {
  const Clearance here = clearance(shape, p_W, above_m);
  return here.distance_m < 0.0 ? Vec3{p_W - here.distance_m * here.away_W} : p_W;
}

Vec3 SlidingPoint::follow(const Vec3& p_W) {
  constexpr int kParts = 20;
  const Vec3 from = is_placed_ ? tool_W_ : p_W;
  is_placed_ = true;
  for (int part = 1; part <= kParts; ++part) {
    tool_W_ = from + (p_W - from) * part / kParts;
    slide(tool_W_);
  }
  return point_W_;
}

void SlidingPoint::slide(const Vec3& p_W) {
  constexpr double kStep_m = 2e-6;
  constexpr double kHeld_m = 1e-9;
  constexpr int kMostSteps = 2000;
  if (is_free_) {
    is_free_ = clearance(shape_, p_W, above_m_).distance_m >= 0.0;
    point_W_ = resting_place(shape_, p_W, above_m_);
  }
  for (int step = 0; step < kMostSteps && !is_free_; ++step) {
    const Clearance here = clearance(shape_, point_W_, above_m_);
    point_W_ -= here.distance_m * here.away_W;
    const Vec3 pull = p_W - point_W_;
    const double pressure_m = -pull.dot(here.away_W);
    const Vec3 along = pull + pressure_m * here.away_W;
    const double left_m = along.norm() - mu_ * pressure_m;
    if (pressure_m <= 0.0) {
      is_free_ = true;
      point_W_ = p_W;
    } else if (left_m <= kHeld_m) {
      return;
    } else {
      point_W_ += std::min(left_m, kStep_m) / along.norm() * along;
    }
  }
}

}  // namespace tactus::testing
