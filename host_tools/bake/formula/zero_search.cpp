// The search halves the bounds along the longest side, again and again, and leaves out the parts in
// which interval arithmetic proves that the formula keeps its sign. From the middles of the parts
// it goes down the slope of |f|. It looks in turn at the part whose middle is nearest to 0, which
// leads to thin shapes soon, and at the largest part, so that those that are left are small.
#include "host_tools/bake/formula/zero_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "host_tools/bake/formula/box_parts.h"
#include "rendering/contact/implicit_sample.h"

namespace tactus::host {
namespace {

using rendering::Box;
using rendering::FormulaView;
using rendering::Interval;

// The search ends after about this many instructions, a second or two.
constexpr double kMostCost = 3e8;
// The costs of a box and of a gradient, in values.
constexpr double kBoxCost = 5.0;
constexpr double kGradientCost = 3.0;
// The share of the bounds' longest side below which a double is too coarse for a part.
constexpr double kFinestShare = 0x1p-44;

// Returns the zero between two places, of which the formula is below 0 at `below` alone, to the
// rounding of a double.
Vec3 bisected_zero(const FormulaView& formula, Vec3 below, Vec3 above) {
  constexpr int kHalvings = 60;
  for (int i = 0; i < kHalvings; ++i) {
    const Vec3 middle = 0.5 * (below + above);
    (evaluate(formula, middle) < 0.0 ? below : above) = middle;
  }
  return below;
}

class Search {
 public:
  Search(const FormulaView& formula, const Box& bounds, double unit_m)
      : formula_(formula), bounds_(bounds), unit_m_(unit_m) {}

  ZeroSearch run() {
    look_at_grid();
    push(bounds_);
    for (bool largest = false; !crossing_ && !parts_.is_empty() && cost_ < kMostCost;
         largest = !largest) {
      look_at(parts_.take(largest));
    }
    return result();
  }

 private:
  // Returns f as it is seen from the side of the first place, so that it is above 0 at first. What
  // is no number counts as far above. Keeps the place if it is the nearest to 0, or beyond it.
  double height_at(const Vec3& p) {
    count(1.0);
    const double f = evaluate(formula_, p);
    if (std::isnan(f)) {
      return std::numeric_limits<double>::max();
    }
    if (side_ == 0.0 && f != 0.0) {
      side_ = f < 0.0 ? -1.0 : 1.0;
      first_ = p;
    }
    const double height = side_ * f;
    if (height < 0.0 && !crossing_) {
      crossing_ =
          side_ < 0.0 ? bisected_zero(formula_, first_, p) : bisected_zero(formula_, p, first_);
    }
    if (height < nearest_.height) {
      nearest_.height = height;
      nearest_.p = p;
    }
    return height;
  }

  // Looks at the points of a grid: most formulas change their sign there.
  void look_at_grid() {
    constexpr int kSide = 21;
    const Vec3 step = (bounds_.upper - bounds_.lower) / (kSide - 1);
    for (int i = 0; i < kSide * kSide * kSide && !crossing_; ++i) {
      const int z = i / (kSide * kSide);
      const Vec3 at(i % kSide, i / kSide % kSide, z);
      height_at(bounds_.lower + step.cwiseProduct(at));
    }
  }

  // Returns true if there is nothing to look for in a box: no zero or, after one is found, no
  // change of the sign.
  bool is_settled(const Box& box) {
    count(kBoxCost);
    const Interval range = evaluate_box(formula_, box.lower, box.upper);
    const double least = side_ < 0.0 ? -range.upper() : range.lower();
    return touch_ ? least >= 0.0 : least > 0.0;
  }

  void push(const Box& box) {
    if (!is_settled(box)) {
      parts_.add(box, height_at(middle_of(box)));
    }
  }

  void look_at(const Box& box) {
    if (size_of(box) <= point()) {
      touch_ = touch_.value_or(middle_of(box));
      return;
    }
    go_down(middle_of(box));
    if (touch_ && is_settled(box)) {
      return;
    }
    for (const Box& half : halves_of(box)) {
      push(half);
    }
  }

  // Goes down the slope from p: by Newton's step for a distance and a little more, so that it comes
  // out beyond a zero, and on as long as that leads down. A place that is 0 to a point's size is a
  // touch.
  void go_down(Vec3 p) {
    constexpr int kMostSteps = 60;
    constexpr int kTrySteps = 6;
    constexpr double kBeyond = 1.01;
    constexpr double kLeastFall = 0.7;
    double height = height_at(p);
    const double start = height;
    for (int i = 0; i < kMostSteps && !crossing_; ++i) {
      count(kGradientCost);
      const rendering::ValueAndGradient there = evaluate_gradient(formula_, p);
      const Vec3 step = -kBeyond * there.value / there.gradient.squaredNorm() * there.gradient;
      const double before = height;
      if (!step.allFinite() || !lower_along(p, height, step) || height == 0.0) {
        break;
      }
      if (i == kTrySteps && height > kLeastFall * start) {
        return;
      }
      if (height > 0.999 * before) {
        break;
      }
    }
    if (!crossing_ && !touch_ && is_point_at_zero(p)) {
      touch_ = p;
    }
  }

  // Moves p along a step, or twice, four times ... or half of it, where the height is less. Returns
  // false if it is less at none of them.
  bool lower_along(Vec3& p, double& height, const Vec3& step) {
    constexpr int kMostDoublings = 30;
    constexpr int kMostHalvings = 12;
    const Vec3 from = p;
    double share = 1.0;
    const auto try_share = [&] {
      const Vec3 q = (from + share * step).cwiseMax(bounds_.lower).cwiseMin(bounds_.upper);
      const double there = height_at(q);
      const bool is_lower = there < height;
      if (is_lower) {
        p = q;
        height = there;
      }
      return is_lower;
    };
    if (try_share()) {
      for (int i = 0; i < kMostDoublings && !crossing_; ++i) {
        share *= 2.0;
        if (!try_share()) {
          break;
        }
      }
      return true;
    }
    for (int i = 0; i < kMostHalvings; ++i) {
      share *= 0.5;
      if (try_share()) {
        return true;
      }
    }
    return false;
  }

  // Returns true if interval arithmetic does not tell the formula from 0 in a part of a point's
  // size about p.
  bool is_point_at_zero(const Vec3& p) {
    const Vec3 half = Vec3::Constant(0.5 * point());
    return !is_settled({.lower = p - half, .upper = p + half});
  }

  // Returns the size of a part that counts as a point.
  [[nodiscard]] double point() const {
    return std::max(kPoint_m / unit_m_, kFinestShare * size_of(bounds_));
  }

  void count(double values) { cost_ += values * static_cast<double>(formula_.instructions.size()); }

  // Returns true if the formula is 0 all about a place, so far that the tracker has no slope to
  // rest on. The directions are none along which a surface is likely to lie.
  bool is_flat_about(const Vec3& p) {
    const double flat = 2.0 * rendering::kImplicitRest_m / unit_m_;
    const Vec3 away = Vec3::Constant(flat).cwiseMin(0.5 * (bounds_.upper - bounds_.lower));
    const Vec3 middle = p.cwiseMax(bounds_.lower + away).cwiseMin(bounds_.upper - away);
    for (unsigned k = 0; k < 8; ++k) {
      const Vec3 direction((k & 1U) != 0 ? 0.31 : -0.47, (k & 2U) != 0 ? 0.77 : -0.91,
                           (k & 4U) != 0 ? 0.53 : -0.67);
      if (evaluate(formula_, middle + away.cwiseProduct(direction)) != 0.0) {
        return false;
      }
    }
    return true;
  }

  ZeroSearch result() {
    if (!crossing_ && !touch_) {
      go_down(nearest_.p);
    }
    ZeroSearch result{.kind = ZeroKind::none,
                      .place = nearest_.p,
                      .value = evaluate(formula_, nearest_.p),
                      .is_below = side_ < 0.0};
    if (crossing_) {
      result = {.kind = ZeroKind::crossed, .place = *crossing_, .is_below = side_ < 0.0};
    } else if (touch_) {
      result.kind =
          result.value == 0.0 && is_flat_about(nearest_.p) ? ZeroKind::flat : ZeroKind::touched;
    } else if (!parts_.is_empty()) {
      const Box largest = parts_.take(true);
      result.kind = ZeroKind::undecided;
      result.undecided_size = size_of(largest);
      result.undecided = middle_of(largest);
    }
    return result;
  }

  const FormulaView& formula_;
  const Box& bounds_;
  double unit_m_;
  // The sign of f at the first place where it is not 0; 0 while there is none.
  double side_ = 0.0;
  Vec3 first_ = Vec3::Zero();
  // The place with the least height.
  struct Place {
    Vec3 p = Vec3::Zero();
    double height = std::numeric_limits<double>::infinity();
  };
  Place nearest_;
  // A change of the sign, and a place that is 0 to a point's size.
  std::optional<Vec3> crossing_;
  std::optional<Vec3> touch_;
  BoxParts parts_;
  double cost_ = 0.0;
};

}  // namespace

ZeroSearch search_zero(const FormulaView& formula, const Box& bounds, double unit_m) {
  return Search(formula, bounds, unit_m).run();
}

}  // namespace tactus::host
