// Finds where a straight segment first meets an implicit surface, by interval arithmetic. A part of
// the segment counts as free only if no point of it can lie behind the surface, so nothing is too
// thin to be met. ImplicitTracker (implicit_tracking.h) and its parts use it.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "rendering/surface/implicit_surface.h"

namespace tactus::rendering {

// A formula seen from one side, in the object frame: F = side * f is above 0 where the proxy may
// be. Counts the instructions that it carries out.
class ImplicitField {
 public:
  // `side` is 1 or -1; `budget` bounds the number of instructions evaluated.
  ImplicitField(const ImplicitSurface& surface, double side, std::size_t budget)
      : surface_(surface), side_(side), budget_(budget) {}

  // Sets the side from which the surface is seen: 1 or -1.
  void set_side(double side) { side_ = side; }
  // Returns the surface with its bounds, pose and scale.
  [[nodiscard]] const ImplicitSurface& surface() const { return surface_; }

  // Returns F at p_O. NaN counts as above 0; a segment into a region where the formula gives no
  // number is blocked.
  double value(const Vec3& p_O);
  // Returns F and its gradient at p_O. A gradient that is not finite is given as zero.
  ValueAndGradient value_and_gradient(const Vec3& p_O);
  // Returns F and its gradient at two points, as value_and_gradient() does at each.
  std::array<ValueAndGradient, 2> values_and_gradients(const Vec3& p_O, const Vec3& q_O);
  // Returns bounds of F and of its slope over the shares `t` of the segment, by interval
  // arithmetic.
  SegmentRange along(const Vec3& from_O, const Vec3& segment_O, const Interval& t);

  // Returns the number of instructions that are left of the budget.
  [[nodiscard]] std::size_t left() const { return budget_; }
  // Returns true if the budget allows one more evaluation.
  [[nodiscard]] bool can_evaluate() const { return budget_ >= size(); }

 private:
  // Returns the number of instructions of one evaluation.
  [[nodiscard]] std::size_t size() const { return surface_.formula.instructions.size(); }
  // Returns f and its gradient as they are seen from the side.
  [[nodiscard]] ValueAndGradient from_side(const ValueAndGradient& f) const;
  // Takes one evaluation from the budget.
  void count() { budget_ -= can_evaluate() ? size() : budget_; }

  const ImplicitSurface& surface_;
  double side_;
  std::size_t budget_;
};

// The state of a segment after a search.
enum class SegmentState : unsigned char {
  free,     // all of it
  blocked,  // F falls below 0 just behind `free_to`, or comes nearer to 0 there than 1 nm of travel
            // shows
  unknown,  // the budget ran out; free up to `free_to`
};

// The result of a search.
struct Crossing {
  SegmentState state = SegmentState::free;
  // The share of the segment, in [0, 1], up to which F >= 0 from the start on.
  double free_to = 1.0;
  double blocked_at =
      1.0;  // for SegmentState::blocked: F < 0 here, or undecided; at most 1 nm further
};

// F at the ends of a segment, where the caller has evaluated it there: ImplicitField::value at
// exactly these points, from the same side.
struct EndValues {
  std::optional<double> from;
  std::optional<double> to;
};

// Returns the first place on the segment between two points within the bounds where F falls below
// 0. It looks at `most_ranges` ranges at most, and evaluates F within the field's budget; what is
// `known` is not evaluated again. F(from) must be >= 0.
Crossing first_crossing(ImplicitField& field, const Vec3& from_O, const Vec3& to_O,
                        std::size_t most_ranges, const EndValues& known = {});

}  // namespace tactus::rendering
