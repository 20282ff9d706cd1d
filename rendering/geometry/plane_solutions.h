// The points nearest to h on one, two and three planes, in closed form. With r = d - n . h, how far
// each plane is from h along its normal, and
//   g = n1 x n2, along the crease of the first two,   e = g x n1, in the first plane across it,
// the steps from h to the point go one plane at a time:
//   one:    r1 n1
//   two:    r1 n1 + a e,        a = (r2 - (n1 . n2) r1) / g^2
//   three:  r1 n1 + a e + b g,  b = (r3 - (n1 . n3) r1 - a (n3 . e)) / (n3 . g)
// so that no later part disturbs what the earlier ones settled, and nothing large cancels. They are
// sums of pressure times normal; the pressures, which are the Lagrange multipliers, follow
// backwards. This takes 6, 33 and 56 multiplications and divisions.
//
// Between nearly parallel planes g is the product of n1 with n2 - n1, which is exact, and not with
// n2, which would leave the rounding of a product of unit vectors. Working from h keeps the
// rounding relative to the depth, not to the size of the world.
//
// Templates over the scalar, so that a test counts the operations of the code that runs.
#pragma once

#include <array>
#include <cstddef>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace tactus::rendering {

// The half space { x : normal . x >= offset }; normal is a unit vector.
template <class Scalar>
struct HalfSpace {
  using Vector = Eigen::Matrix<Scalar, 3, 1>;
  Vector normal = Vector::UnitY();
  // The plane's distance from the origin along the normal, m.
  Scalar offset = Scalar(0);

  // Returns how far x would have to move along the normal to reach the plane, m.
  [[nodiscard]] Scalar residual(const Vector& x) const { return offset - normal.dot(x); }
};

template <class Scalar>
struct PlaneSolution {
  // The step from h to the point, m.
  Eigen::Matrix<Scalar, 3, 1> step = Eigen::Matrix<Scalar, 3, 1>::Zero();
  // The Lagrange multipliers: how far each plane pushes, m.
  std::array<Scalar, 3> pressure{};
};

// Returns true if the plane is active; otherwise h is in front of it.
template <class Scalar>
bool solve_one_plane(const Eigen::Matrix<Scalar, 3, 1>& h, const HalfSpace<Scalar>& first,
                     PlaneSolution<Scalar>& s) {
  s.pressure[0] = first.residual(h);
  s.step = s.pressure[0] * first.normal;
  return s.pressure[0] > Scalar(0);
}

// The first two planes, as seen from h: the terms that two and three planes share.
template <class Scalar>
struct Crease {
  using Vector = Eigen::Matrix<Scalar, 3, 1>;

  // Prepares both planes. The cross product is taken with the sum or the difference of the normals,
  // which nearly cancel, and not with the second normal (see above).
  Crease(const Vector& h, const HalfSpace<Scalar>& first, const HalfSpace<Scalar>& second)
      : cosine(first.normal.dot(second.normal)),
        along(first.normal.cross(cosine < Scalar(0) ? Vector(second.normal + first.normal)
                                                    : Vector(second.normal - first.normal))),
        across(along.cross(first.normal)),
        squared_sine(along.squaredNorm()),
        residual(first.residual(h)),
        travel(second.residual(h) - cosine * residual) {}

  // Returns true if the angle is rounding, or so small that either plane is as good as both.
  [[nodiscard]] bool parallel() const { return squared_sine < Scalar(1e-22); }

  // The cosine of the angle between the normals.
  Scalar cosine;
  // The direction g of the crease, not unit.
  Vector along;
  // The direction e in the first plane across the crease, of the length of g.
  Vector across;
  // g^2: the squared sine of the angle between the normals.
  Scalar squared_sine;
  // r1: the distance of h below the first plane, m.
  Scalar residual;
  // a g^2: the way across that is left to the second plane, times g^2.
  Scalar travel;
};

// Returns true if both planes are active; otherwise one of them is enough. False also for parallel
// planes.
template <class Scalar>
bool solve_two_planes(const Eigen::Matrix<Scalar, 3, 1>& h, const HalfSpace<Scalar>& first,
                      const HalfSpace<Scalar>& second, PlaneSolution<Scalar>& s) {
  const Crease<Scalar> crease(h, first, second);
  if (crease.parallel()) {
    return false;
  }
  s.pressure[1] = crease.travel / crease.squared_sine;
  s.pressure[0] = crease.residual - crease.cosine * s.pressure[1];
  s.step = crease.residual * first.normal + s.pressure[1] * crease.across;
  return s.pressure[0] > Scalar(0) && s.pressure[1] > Scalar(0);
}

// Returns true if all three planes are active; otherwise two of them are enough. False also for
// normals in one plane.
template <class Scalar>
bool solve_three_planes(const Eigen::Matrix<Scalar, 3, 1>& h, const HalfSpace<Scalar>& first,
                        const HalfSpace<Scalar>& second, const HalfSpace<Scalar>& third,
                        PlaneSolution<Scalar>& s) {
  using Vector = Eigen::Matrix<Scalar, 3, 1>;
  const Crease<Scalar> crease(h, first, second);
  const Scalar cosine = first.normal.dot(third.normal);
  const Vector tilt = third.normal - first.normal;  // along and across are normal to the first
  const Scalar volume = tilt.dot(crease.along);
  const Scalar flat(1e-14);  // below it the volume is rounding
  if (crease.parallel() || (volume < flat && -volume < flat)) {
    return false;
  }
  const Scalar tilt_across = tilt.dot(crease.across);
  const Scalar across = crease.travel / crease.squared_sine;
  const Scalar along =
      (third.residual(h) - cosine * crease.residual - across * tilt_across) / volume;
  s.step = crease.residual * first.normal + across * crease.across + along * crease.along;
  s.pressure[2] = along * crease.squared_sine / volume;
  s.pressure[1] = across - s.pressure[2] * tilt_across / crease.squared_sine;
  s.pressure[0] = crease.residual - crease.cosine * s.pressure[1] - cosine * s.pressure[2];
  return s.pressure[0] > Scalar(0) && s.pressure[1] > Scalar(0) && s.pressure[2] > Scalar(0);
}

}  // namespace tactus::rendering
