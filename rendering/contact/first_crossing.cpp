// The search for the first crossing halves the segment from its start on: ranges that are proved
// free are left behind, the nearest other one is looked at next. For a range it knows by interval
// arithmetic bounds of F and of its slope dF/dt over the whole of it, and F at both ends: an end is
// evaluated when the bounds alone do not decide.
//
//   free:     the bound of F is above 0, or the slope allows no dip below 0 between the two ends
//   crossed:  F is below 0 at the far end and falls all the way, so there is one crossing
//   else:     the range is halved, and its first half is looked at
//
// A crossing is narrowed by false position to a nanometre. A range shorter than that which is not
// proved free counts as blocked: a surface that the segment touches cannot be told from one that it
// crosses.
#include "rendering/contact/first_crossing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace tactus::rendering {
namespace {

// A crossing is located, and a touch distinguished from a miss, to this.
constexpr double kResolution_m = 1e-9;
// 100 m halved this often is below the resolution.
constexpr std::size_t kMostHalvings = 40;

// An end of a range: its share of the segment, and F there once it is evaluated.
struct End {
  double t = 0.0;
  std::optional<double> value;  // F
};

// An end whose F is known.
struct KnownEnd {
  double t = 0.0;
  double value = 0.0;  // F
};

// Returns true if F and its slope are finite all over a range, so that F has no pole there.
bool is_bounded(const SegmentRange& range) {
  return std::isfinite(range.value.lower()) && std::isfinite(range.value.upper()) &&
         std::isfinite(range.slope.lower()) && std::isfinite(range.slope.upper());
}

// Returns the least possible F between two ends of a range, from its values there and its slope: F
// is above the line that falls from `a` at the lowest slope and above the one that reaches `b` at
// the highest, so it is above the point where they meet. An end at a pole or without a value tells
// nothing.
double least_value(const KnownEnd& a, const KnownEnd& b, const Interval& slope) {
  constexpr double kLargest = std::numeric_limits<double>::max();
  if (a.value >= kLargest || b.value >= kLargest) {
    return -kLargest;
  }
  if (slope.lower() >= 0.0) {
    return a.value;
  }
  if (slope.upper() <= 0.0) {
    return b.value;
  }
  const double width = b.t - a.t;
  const double meet = (a.value - b.value + slope.upper() * width) / (slope.upper() - slope.lower());
  return a.value + slope.lower() * std::clamp(meet, 0.0, width);
}

class Search {
 public:
  Search(ImplicitField& field, const Vec3& from, const Vec3& to)
      : field_(field), from_(from), to_(to), segment_(to - from) {
    // A nanometre of the world as a share of the segment, but never below a double's rounding of 1.
    const double length_m = segment_.norm() * field.surface().scale_m;
    resolution_ = std::max(kResolution_m / length_m, std::numeric_limits<double>::epsilon());
  }

  // Runs the search with at most `most_ranges` ranges; then the segment is free up to the last one
  // proved.
  Crossing run(std::size_t most_ranges, const EndValues& known) {
    // Ends that wait to the right of the range, the nearest on top.
    std::array<End, kMostHalvings + 1> open;
    std::size_t depth = 0;
    End a{.t = 0.0, .value = known.from};
    open[depth++] = {.t = 1.0, .value = known.to};
    for (std::size_t ranges = 0; depth > 0; ++ranges) {
      End& b = open[depth - 1];
      if (ranges == most_ranges || !field_.can_evaluate()) {
        return {.state = SegmentState::unknown, .free_to = a.t};
      }
      const SegmentRange range = field_.along(from_, segment_, {a.t, b.t});
      if (is_free(a, b, range)) {
        a = b;
        --depth;
        continue;
      }
      if (value(b) < 0.0 && range.slope.upper() < 0.0) {
        return narrow({.t = a.t, .value = value(a)}, {.t = b.t, .value = value(b)});
      }
      if (b.t - a.t <= resolution_ || depth == open.size()) {
        return {.state = SegmentState::blocked, .free_to = a.t, .blocked_at = b.t};
      }
      const KnownEnd middle = at(0.5 * (a.t + b.t));
      if (middle.value < 0.0) {
        depth = 0;  // what lies behind does not matter
      }
      open[depth++] = {.t = middle.t, .value = middle.value};
    }
    return {};
  }

 private:
  KnownEnd at(double t) {
    return {.t = t, .value = field_.value(t == 1.0 ? to_ : Vec3{from_ + t * segment_})};
  }

  // Returns F at an end, and evaluates it there at the first call.
  double value(End& end) {
    if (!end.value) {
      end.value = at(end.t).value;
    }
    return *end.value;
  }

  // Returns true if F is proved not to fall below 0 between two ends. Where F has no pole and only
  // rises or only falls, its lower end decides.
  bool is_free(End& a, End& b, const SegmentRange& range) {
    if (range.value.lower() > 0.0) {
      return true;
    }
    if (is_bounded(range) && range.slope.lower() >= 0.0) {
      return value(a) >= 0.0;
    }
    if (is_bounded(range) && range.slope.upper() <= 0.0) {
      return value(b) >= 0.0;
    }
    const double at_a = value(a);
    const double at_b = value(b);
    const double least =
        least_value({.t = a.t, .value = at_a}, {.t = b.t, .value = at_b}, range.slope);
    return least >= 0.0 && (!is_near_zero(least, at_a + at_b, range) ||
                            least > rounding_at(a.t) + rounding_at(b.t));
  }

  // Returns true if rounding may have made a least value that is not below 0: F nearly reaches 0
  // in a kink, as |x| does, or is 0 but for rounding at both ends.
  static bool is_near_zero(double least, double ends, const SegmentRange& range) {
    constexpr double kNear = 1e-6;
    return least <= kNear * ends || ends <= kNear * range.value.upper();
  }

  // Returns a bound of the rounding in F at one place.
  double rounding_at(double t) {
    const Interval value = field_.along(from_, segment_, {t, t}).value;
    return value.upper() - value.lower();
  }

  // F falls all the way from a to b, and below 0: false position. An end that stays a second time
  // counts half (the Illinois rule: Dowell and Jarratt, BIT 11, 1971), so that both close in.
  Crossing narrow(KnownEnd a, KnownEnd b) {
    constexpr int kMostSteps = 40;
    double weight_a = a.value;
    double weight_b = b.value;
    bool moved_a = false;
    bool moved_b = false;
    for (int step = 0; step < kMostSteps && b.t - a.t > resolution_ && field_.can_evaluate();
         ++step) {
      const double share = weight_a / (weight_a - weight_b);
      const double guess = a.t + (b.t - a.t) * (share >= 0.0 && share <= 1.0 ? share : 0.5);
      const KnownEnd middle =
          at(std::clamp(guess, a.t + 0.4 * resolution_, b.t - 0.4 * resolution_));
      if (middle.value < 0.0) {
        weight_a *= moved_b ? 0.5 : 1.0;
        b = middle;
        weight_b = middle.value;
      } else {
        weight_b *= moved_a ? 0.5 : 1.0;
        a = middle;
        weight_a = middle.value;
      }
      moved_a = middle.value >= 0.0;
      moved_b = !moved_a;
    }
    return {.state = SegmentState::blocked, .free_to = a.t, .blocked_at = b.t};
  }

  ImplicitField& field_;
  const Vec3& from_;
  const Vec3& to_;
  Vec3 segment_;
  double resolution_ = 0.0;
};

}  // namespace

// NaN, such as from the root of a negative number, counts as far above 0.
double ImplicitField::value(const Vec3& p_O) {
  count();
  const double f = evaluate(surface_.formula, p_O);
  return std::isnan(f) ? std::numeric_limits<double>::max() : side_ * f;
}

ValueAndGradient ImplicitField::value_and_gradient(const Vec3& p_O) {
  count();
  return from_side(evaluate_gradient(surface_.formula, p_O));
}

std::array<ValueAndGradient, 2> ImplicitField::values_and_gradients(const Vec3& p_O,
                                                                    const Vec3& q_O) {
  count();
  count();
  const auto f = evaluate_gradients(surface_.formula, p_O, q_O);
  return {from_side(f[0]), from_side(f[1])};
}

ValueAndGradient ImplicitField::from_side(const ValueAndGradient& f) const {
  return {.value = std::isnan(f.value) ? std::numeric_limits<double>::max() : side_ * f.value,
          .gradient = f.gradient.allFinite() ? Vec3{side_ * f.gradient} : Vec3::Zero()};
}

SegmentRange ImplicitField::along(const Vec3& from_O, const Vec3& segment_O, const Interval& t) {
  count();
  const SegmentRange range = evaluate_along(surface_.formula, from_O, segment_O, t);
  return side_ > 0.0 ? range : SegmentRange{.value = -range.value, .slope = -range.slope};
}

Crossing first_crossing(ImplicitField& field, const Vec3& from_O, const Vec3& to_O,
                        std::size_t most_ranges, const EndValues& known) {
  return Search(field, from_O, to_O).run(most_ranges, known);
}

}  // namespace tactus::rendering
