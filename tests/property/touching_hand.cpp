#include "tests/property/touching_hand.h"

#include <algorithm>
#include <cmath>

namespace tactus::testing {

TouchingHand::TouchingHand(const TouchedShape& shape, double most_step_m, std::uint64_t seed)
    : shape_(shape), most_step_m_(most_step_m), random_(seed) {
  constexpr double kStartClear_m = 2e-4;
  do {
    const Vec3 place = any_place();
    const Clearance there = clearance(shape_, place);
    tool_W_ = place + (1.5 * kStartClear_m - there.distance_m) * there.away_W;
  } while (clearance(shape_, tool_W_).distance_m < kStartClear_m || is_in_tip(tool_W_));
}

Vec3 TouchingHand::next() {
  const Vec3 now = tool_W_;
  move();
  return now;
}

void TouchingHand::move() {
  if (ticks_left_-- <= 0) {
    choose_target();
  }
  const Vec3 way = target_W_ - tool_W_;
  const double length = way.norm();
  Vec3 wish = length > step_m_ ? Vec3{tool_W_ + step_m_ / length * way} : target_W_;
  // It goes down as far as is allowed where it is, and then as far as where it comes to.
  const Clearance here = clearance(shape_, tool_W_);
  const double down = -here.away_W.dot(wish - tool_W_);
  wish += std::max(0.0, down - here.distance_m - allowed_depth_m(tool_W_)) * here.away_W;
  const Clearance there = clearance(shape_, wish);
  wish += std::max(0.0, -allowed_depth_m(wish) - there.distance_m) * there.away_W;
  if (is_in_tip(wish)) {
    choose_target();
  } else {
    tool_W_ = wish;
  }
}

Vec3 TouchingHand::any_place() {
  constexpr double kPlane_m = 0.05;
  constexpr double kAround = 0.7;
  const rendering::Bounds box = bounds(shape_.primitive);
  const double size_m = shape_.primitive.kind == rendering::PrimitiveKind::plane
                            ? kPlane_m
                            : kAround * (box.upper_W - box.lower_W).maxCoeff();
  const auto any = [&] { return size_m * (2.0 * unit_(random_) - 1.0); };
  return shape_.primitive.X_WO.translation + Vec3{any(), any(), any()};
}

void TouchingHand::choose_target() {
  constexpr double kSlowest = 0.01;
  constexpr double kPressing = 0.7;
  target_W_ = any_place();
  if (unit_(random_) < kPressing) {
    const Clearance there = clearance(shape_, target_W_);
    target_W_ -= (there.distance_m + kDeepest_m * unit_(random_)) * there.away_W;
  }
  step_m_ = most_step_m_ * std::pow(kSlowest, unit_(random_));
  ticks_left_ = 20 + static_cast<int>(200.0 * unit_(random_));
}

double TouchingHand::allowed_depth_m(const Vec3& p_W) const {
  constexpr double kFarthestReach_m = 0.02;
  constexpr double kClearOfEdges_m = 2e-6;
  constexpr double kMostStep_m = 1e-3;
  const double room_m = reach(shape_, p_W, kFarthestReach_m) - 2.0 * kMostStep_m;
  return std::min(kDeepest_m, kMostOfReach * std::max(0.0, room_m)) - kClearOfEdges_m;
}

bool TouchingHand::is_in_tip(const Vec3& p_W) const {
  constexpr double kTip_m = 1e-3;
  const rendering::Primitive& cone = shape_.primitive;
  if (cone.kind != rendering::PrimitiveKind::cone || shape_.side == Side::outside) {
    return false;
  }
  const Vec3 place_O = cone.X_WO.point_in(resting_place(shape_, p_W, 0.0));
  return std::hypot(place_O.x(), place_O.z()) < kTip_m && place_O.y() > 0.5 * cone.dimensions_m[1];
}

}  // namespace tactus::testing
