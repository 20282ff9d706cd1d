#include "host_tools/bake/formula/formula_functions.h"

#include <array>
#include <cmath>
#include <numbers>

namespace tactus::host {
namespace {

using rendering::Opcode;
using Builder = FormulaBuilder;
using Value = FormulaBuilder::Value;
using Coordinates = FormulaCoordinates;
using Arguments = std::span<const Value>;
using Result = FormulaFunction::Result;

// Short forms for the shapes below.
Value square(Builder& b, Value a) {
  return b.multiply(a, a);
}

Value root(Builder& b, Value a) {
  return b.function(Opcode::square_root, a);
}

Value magnitude(Builder& b, Value a) {
  return b.function(Opcode::magnitude, a);
}

Value half(Builder& b, Value a) {
  return b.multiply(b.constant(0.5), a);
}

Value times(Builder& b, double c, Value a) {
  return b.multiply(b.constant(c), a);
}

Value sum(Builder& b, std::initializer_list<Value> parts) {
  Value result = b.constant(0.0);
  for (const Value part : parts) {
    result = b.add(result, part);
  }
  return result;
}

// Return the distance from the origin in the plane and in space.
Value length2(Builder& b, Value x, Value y) {
  return root(b, b.add(square(b, x), square(b, y)));
}

Value length3(Builder& b, Value x, Value y, Value z) {
  return root(b, sum(b, {square(b, x), square(b, y), square(b, z)}));
}

// |a| - size / 2: below 0 between two planes that are `size` apart.
Value slab(Builder& b, Value a, Value size) {
  return b.subtract(magnitude(b, a), half(b, size));
}

// A function that one instruction computes.
template <Opcode opcode>
Result one_operand(Builder& b, const Coordinates& /*at*/, Arguments a) {
  return b.function(opcode, a[0]);
}

// A function of any number of arguments, combined from the left.
template <Value (Builder::*combine)(Value, Value)>
Result all_of(Builder& b, const Coordinates& /*at*/, Arguments a) {
  Value result = a[0];
  for (const Value next : a.subspan(1)) {
    result = (b.*combine)(result, next);
  }
  return result;
}

Result tangent(Builder& b, const Coordinates& /*at*/, Arguments a) {
  return b.divide(b.function(Opcode::sine, a[0]), b.function(Opcode::cosine, a[0]));
}

Result length(Builder& b, const Coordinates& /*at*/, Arguments a) {
  return a.size() == 2 ? length2(b, a[0], a[1]) : length3(b, a[0], a[1], a[2]);
}

// The part of a that is outside of b.
Result difference(Builder& b, const Coordinates& /*at*/, Arguments a) {
  return b.maximum(a[0], b.negate(a[1]));
}

// Ricci's blend of two functions ("A constructive geometry for computer graphics", Computer Journal
// 16(2), 1973), which the user gives in his form.
Result ricci(Builder& b, const Coordinates& /*at*/, Arguments a) {
  const auto p = b.known(a[2]);
  if (!p || !(std::abs(*p) >= 1.0)) {
    return std::unexpected("p must be a number of at least 1, or at most -1");
  }
  return b.power_norm(a[0], a[1], *p);
}

// Ricci's functions are above 0 and equal 1 on the surface; ours are 0 there. So it blends 1 + a/w
// and 1 + b/w and goes back. The sign of p chooses intersection (+) or union (-).
Result blend(Builder& b, Arguments a, Value second, double sign) {
  const auto p = b.known(a[2]);
  if (!p || !(*p >= 1.0)) {
    return std::unexpected("p must be a number of at least 1; larger is sharper");
  }
  const auto w = a.size() > 3 ? b.known(a[3]) : std::optional(1.0);
  if (!w || !(*w > 0.0)) {
    return std::unexpected("w must be a number above 0, about the size of the shapes");
  }
  const auto shifted = [&](Value f) { return b.add(times(b, 1.0 / *w, f), b.constant(1.0)); };
  const Value norm = b.power_norm(shifted(a[0]), shifted(second), sign * *p);
  return times(b, *w, b.subtract(norm, b.constant(1.0)));
}

Result blend_union(Builder& b, const Coordinates& /*at*/, Arguments a) {
  return blend(b, a, a[1], -1.0);
}

Result blend_intersection(Builder& b, const Coordinates& /*at*/, Arguments a) {
  return blend(b, a, a[1], 1.0);
}

Result blend_difference(Builder& b, const Coordinates& /*at*/, Arguments a) {
  return blend(b, a, b.negate(a[1]), 1.0);
}

// The wall of a, half of the thickness to each side of its surface.
Result shell(Builder& b, const Coordinates& /*at*/, Arguments a) {
  return slab(b, a[0], a[1]);
}

// All below a plane: n . p / |n| - d, with the normal n, at the distance d from the origin.
Result plane(Builder& b, const Coordinates& at, Arguments a) {
  const Value along =
      sum(b, {b.multiply(a[0], at.x), b.multiply(a[1], at.y), b.multiply(a[2], at.z)});
  const Value size = length3(b, a[0], a[1], a[2]);
  if (b.known(size) == 0.0) {
    return std::unexpected("the normal is zero; write plane(0, 1, 0, d) for all below y = d");
  }
  return b.subtract(b.divide(along, size), a[3]);
}

// |p| - r.
Result sphere(Builder& b, const Coordinates& at, Arguments a) {
  return b.subtract(length3(b, at.x, at.y, at.z), a[0]);
}

// A box with sides a, b and c: above 0 outside of any of its three slabs.
Result box(Builder& b, const Coordinates& at, Arguments a) {
  return b.maximum(b.maximum(slab(b, at.x, a[0]), slab(b, at.y, a[1])), slab(b, at.z, a[2]));
}

// A cylinder about z with the radius r and the height h.
Result cylinder(Builder& b, const Coordinates& at, Arguments a) {
  return b.maximum(b.subtract(length2(b, at.x, at.y), a[0]), slab(b, at.z, a[1]));
}

// All within the distance r of a piece of the z axis with the length h.
Result capsule(Builder& b, const Coordinates& at, Arguments a) {
  const Value beyond = b.maximum(slab(b, at.z, a[1]), b.constant(0.0));
  return b.subtract(length3(b, at.x, at.y, beyond), a[0]);
}

// The base of radius r lies at z = 0, the tip at z = h: the distance to the line of the side, cut
// off by the base.
Result cone(Builder& b, const Coordinates& at, Arguments a) {
  const Value around = length2(b, at.x, at.y);
  const Value side = b.add(b.multiply(a[1], b.subtract(around, a[0])), b.multiply(a[0], at.z));
  return b.maximum(b.divide(side, length2(b, a[0], a[1])), b.negate(at.z));
}

// A ring about z: the distance from a circle of radius R, less the tube's radius r.
Result torus(Builder& b, const Coordinates& at, Arguments a) {
  const Value around = b.subtract(length2(b, at.x, at.y), a[0]);
  return b.subtract(length2(b, around, at.z), a[1]);
}

// Taubin's heart: (x^2 + 9/4 y^2 + z^2 - 1)^3 - x^2 z^3 - 9/80 y^2 z^3.
Result heart(Builder& b, const Coordinates& at, Arguments /*a*/) {
  const Value x2 = square(b, at.x);
  const Value y2 = square(b, at.y);
  const Value z2 = square(b, at.z);
  const Value body = b.subtract(sum(b, {x2, times(b, 2.25, y2), z2}), b.constant(1.0));
  const Value dent = b.multiply(b.add(x2, times(b, 9.0 / 80.0, y2)), b.multiply(z2, at.z));
  return b.subtract(b.whole_power(body, 3), dent);
}

// Barth's surface of degree 6, which has 65 double points, the most that the degree permits.
Result barth_sextic(Builder& b, const Coordinates& at, Arguments /*a*/) {
  constexpr double kGolden = std::numbers::phi;
  const Value x2 = square(b, at.x);
  const Value y2 = square(b, at.y);
  const Value z2 = square(b, at.z);
  const auto factor = [&](Value u, Value v) {
    return b.subtract(times(b, kGolden * kGolden, u), v);
  };
  const Value planes = b.multiply(b.multiply(factor(x2, y2), factor(y2, z2)), factor(z2, x2));
  const Value ball = b.subtract(sum(b, {x2, y2, z2}), b.constant(1.0));
  return b.subtract(times(b, 4.0, planes), times(b, 1.0 + 2.0 * kGolden, square(b, ball)));
}

// The Klein bottle as the zeros of a polynomial of degree 6, with s = x^2 + y^2 + z^2 - 1:
//
//   (s + 2 y) ((s - 2 y)^2 - 8 z^2) + 16 x z (s - 2 y)
Result klein_bottle(Builder& b, const Coordinates& at, Arguments /*a*/) {
  const Value sphere =
      b.subtract(sum(b, {square(b, at.x), square(b, at.y), square(b, at.z)}), b.constant(1.0));
  const Value two_y = times(b, 2.0, at.y);
  const Value minus = b.subtract(sphere, two_y);
  const Value body = b.subtract(square(b, minus), times(b, 8.0, square(b, at.z)));
  const Value twist = times(b, 16.0, b.multiply(b.multiply(at.x, at.z), minus));
  return b.add(b.multiply(b.add(sphere, two_y), body), twist);
}

// Schoen's minimal surface, approximated by the first term of its Fourier series.
Result gyroid(Builder& b, const Coordinates& at, Arguments /*a*/) {
  const auto wave = [&](Value u, Value v) {
    return b.multiply(b.function(Opcode::sine, u), b.function(Opcode::cosine, v));
  };
  return sum(b, {wave(at.x, at.y), wave(at.y, at.z), wave(at.z, at.x)});
}

// Goursat's surface of degree 4 with the symmetry of a cube; it looks like a cube of tubes.
Result quartic(Builder& b, const Coordinates& at, Arguments /*a*/) {
  const auto part = [&](Value u) {
    const Value u2 = square(b, u);
    return b.multiply(u2, b.subtract(u2, b.constant(5.0)));
  };
  return b.add(sum(b, {part(at.x), part(at.y), part(at.z)}), b.constant(11.8));
}

// A limit for functions of any number of arguments.
constexpr std::size_t kAnyCount = 64;

// Every function of the language: its name, its arguments as the help shows them, how many at least
// and at most, and what builds it.
constexpr std::array kFunctions{
    FormulaFunction{"sqrt", "a", 1, 1, one_operand<Opcode::square_root>},
    FormulaFunction{"sin", "a", 1, 1, one_operand<Opcode::sine>},
    FormulaFunction{"cos", "a", 1, 1, one_operand<Opcode::cosine>},
    FormulaFunction{"tan", "a", 1, 1, tangent},
    FormulaFunction{"exp", "a", 1, 1, one_operand<Opcode::exponential>},
    FormulaFunction{"log", "a", 1, 1, one_operand<Opcode::logarithm>},
    FormulaFunction{"abs", "a", 1, 1, one_operand<Opcode::magnitude>},
    FormulaFunction{"length", "a, b, c", 2, 3, length},
    FormulaFunction{"min", "a, b, ...", 2, kAnyCount, all_of<&Builder::minimum>},
    FormulaFunction{"max", "a, b, ...", 2, kAnyCount, all_of<&Builder::maximum>},
    FormulaFunction{"union", "a, b, ...", 2, kAnyCount, all_of<&Builder::minimum>},
    FormulaFunction{"intersection", "a, b, ...", 2, kAnyCount, all_of<&Builder::maximum>},
    FormulaFunction{"difference", "a, b", 2, 2, difference},
    FormulaFunction{"ricci", "a, b, p", 3, 3, ricci},
    FormulaFunction{"blend_union", "a, b, p, w", 3, 4, blend_union},
    FormulaFunction{"blend_intersection", "a, b, p, w", 3, 4, blend_intersection},
    FormulaFunction{"blend_difference", "a, b, p, w", 3, 4, blend_difference},
    FormulaFunction{"shell", "a, thickness", 2, 2, shell},
    FormulaFunction{"plane", "nx, ny, nz, d", 4, 4, plane},
    FormulaFunction{"sphere", "r", 1, 1, sphere},
    FormulaFunction{"box", "a, b, c", 3, 3, box},
    FormulaFunction{"cylinder", "r, h", 2, 2, cylinder},
    FormulaFunction{"capsule", "r, h", 2, 2, capsule},
    FormulaFunction{"cone", "r, h", 2, 2, cone},
    FormulaFunction{"torus", "R, r", 2, 2, torus},
    FormulaFunction{"heart", "", 0, 0, heart},
    FormulaFunction{"quartic", "", 0, 0, quartic},
    FormulaFunction{"barth_sextic", "", 0, 0, barth_sextic},
    FormulaFunction{"klein_bottle", "", 0, 0, klein_bottle},
    FormulaFunction{"gyroid", "", 0, 0, gyroid},
};

}  // namespace

std::span<const FormulaFunction> formula_functions() {
  return kFunctions;
}

}  // namespace tactus::host
