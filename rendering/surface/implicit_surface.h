// An implicit surface and its place in the world.
#pragma once

#include "rendering/geometry/mesh.h"
#include "rendering/geometry/vector.h"
#include "rendering/surface/formula.h"

namespace tactus::rendering {

// Between two corners, in the object's own units.
struct Box {
  Vec3 lower = Vec3::Constant(-1.0);
  Vec3 upper = Vec3::Constant(1.0);

  [[nodiscard]] bool contains(const Vec3& p) const {
    return (p.array() >= lower.array()).all() && (p.array() <= upper.array()).all();
  }
};

// A point p_O of the object frame O lies in the world at p_WO + scale_m * R_WO * p_O. The placement
// may change from tick to tick; the instructions behind the view are kept alive and unchanged by
// the caller, and have passed check().
struct ImplicitSurface {
  FormulaView formula;  // f(p_O), below 0 inside
  // The surface exists only in here, and ends open at the walls: the cutting planes of Salisbury
  // and Tarr. A solid that shall be closed there is cut in its formula.
  Box bounds_O;
  Mat3 R_WO = Mat3::Identity();
  Vec3 p_WO = Vec3::Zero();  // m
  double scale_m = 1.0;      // metres per unit of the formula, > 0
  // One: f < 0 is solid; it lets out a tool that is inside, and none in. Two: a sheet without an
  // inside, which keeps the tool on the side where it is.
  Sides sides = Sides::one;

  [[nodiscard]] Vec3 to_object(const Vec3& p_W) const {
    return R_WO.transpose() * (p_W - p_WO) / scale_m;
  }
  [[nodiscard]] Vec3 to_world(const Vec3& p_O) const { return p_WO + scale_m * (R_WO * p_O); }
};

}  // namespace tactus::rendering
