#include "rendering/contact/candidate_set.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <new>

#include "rendering/contact/primitive_sweep.h"

namespace tactus::rendering {
namespace {

// Adds one number to each of four 16-bit numbers by multiplication.
constexpr std::uint64_t kInEachOfFour = 0x0001'0001'0001'0001;

// The numbers of the bits that are set in a group of four, ascending, and their count.
struct Numbers {
  std::uint64_t of_each = 0;  // what follows the last is not meant
  std::size_t count = 0;
};
constexpr std::array<Numbers, 16> kNumbersOf = [] {
  std::array<Numbers, 16> all{};
  for (std::uint32_t bits = 0; bits < all.size(); ++bits) {
    std::array<std::uint16_t, 4> numbers{};
    std::size_t count = 0;
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      numbers[count] = static_cast<std::uint16_t>(k);
      count += bits >> k & 1U;
    }
    all[bits] = {.of_each = std::bit_cast<std::uint64_t>(numbers), .count = count};
  }
  return all;
}();

}  // namespace

void CandidateSet::begin_tick(const SceneObjects& scene) {
  may_pause_ = true;
  if (!scene.anything_moved() || trust_.radius < 0.0) {
    return;
  }
  const Vec3 middle = trust_.start + 0.5 * trust_.axis;
  const double reach = trust_.radius + 0.5 * trust_.axis.norm() + margins_.sphere.reach_m;
  const bool disturbed = std::ranges::any_of(scene.movers(), [&](const Mover& mover) {
    return mover.moved &&
           (mover.distance(middle) <= reach || mover.distance_before(middle) <= reach);
  });
  if (disturbed) {
    clear();
    wanted_length_m_ = std::min(wanted_length_m_, kLongTrust_m);
    may_pause_ = false;
  }
}

// Stores the bound as floats, four per vector. Their rounding error is far smaller than the contact
// margin. Heights count from the reach of the sphere, also for objects to which the tool is a
// point.
void CandidateSet::store_bound(std::size_t i, const Float3& normal, double distance) {
  const double nearer = margins_.sphere.reach_m - margins_.of(slots_[i].point_tool).reach_m;
  normal_x_[i] = normal.x;
  normal_y_[i] = normal.y;
  normal_z_[i] = normal.z;
  height_[i] = static_cast<float>(distance + nearer);
}

void CandidateSet::set_bound(std::size_t i, const Vec3& normal, double distance, const Vec3& from) {
  store_bound(i, to_float3(normal), distance - normal.dot(from - trust_.start));
}

// Stores a bound that is always within reach, so that the candidate is always measured.
void CandidateSet::set_no_bound(std::size_t i) {
  normal_x_[i] = normal_y_[i] = normal_z_[i] = 0.0F;
  height_[i] = -1.0F;
}

void CandidateSet::fill_last_four() {
  for (std::size_t i = size_; i % 4 != 0; ++i) {
    normal_x_[i] = normal_y_[i] = normal_z_[i] = 0.0F;
    height_[i] = std::numeric_limits<float>::infinity();
  }
}

CandidateSet::Bounded::Bounded(const CandidateSet& of, const Vec3& p)
    : x(static_cast<float>(p.x() - of.trust_.start.x())),
      y(static_cast<float>(p.y() - of.trust_.start.y())),
      z(static_cast<float>(p.z() - of.trust_.start.z())) {
  constexpr float kRounding = 1e-6F;  // of the largest length involved
  const auto reach = static_cast<float>(of.margins_.sphere.reach_m);
  most = reach + kRounding * (reach + std::abs(x) + std::abs(y) + std::abs(z));
}

void CandidateSet::Within::find(const CandidateSet& of, const Vec3& p, double farther_m) {
  static_assert(kMaxCandidates % 4 == 0);
  const Bounded at(of, p);
  const Floats most = all(at.most + static_cast<float>(farther_m));
  const std::size_t size = of.size_;
  std::size_t found = 0;
  for (std::size_t first = 0; first < size; first += 4) {
    const Floats bound = aligned_floats_at(&of.normal_x_[first]) * at.x +
                         aligned_floats_at(&of.normal_y_[first]) * at.y +
                         aligned_floats_at(&of.normal_z_[first]) * at.z +
                         aligned_floats_at(&of.height_[first]);
    // All four are written, and written over where not near: a branch would mostly be mistaken.
    const Numbers& near = kNumbersOf[which(bound <= most)];
    const std::uint64_t numbers = near.of_each + first * kInEachOfFour;
    std::memcpy(&number[found], &numbers, sizeof numbers);
    found += near.count;
  }
  count = found;
}

void CandidateSet::move_to_end(const Vec3& p) {
  move_to(p);
  const Bounded at(*this, p);
  here_.count = 0;
  for (const std::uint16_t i : there_.numbers()) {
    here_.number[here_.count] = i;
    here_.count += may_reach(i, at) ? 1U : 0U;
  }
  here_place_ = places_;
  here_gathering_ = gatherings_;
}

std::span<const std::uint16_t> CandidateSet::within_reach_here() {
  if (here_place_ != places_ || here_gathering_ != gatherings_) {
    budget_.spend(size_ / kTangentsPerUnit);
    here_.find(*this, place_, 0.0);
    here_place_ = places_;
    here_gathering_ = gatherings_;
  }
  return here_.numbers();
}

std::span<const std::uint16_t> CandidateSet::within_reach(const Vec3& p, double farther_m) {
  budget_.spend(size_ / kTangentsPerUnit);
  there_.find(*this, p, farther_m);
  return there_.numbers();
}

void CandidateSet::build(Candidate& slot, const SceneObjects& scene) {
  ::new (&slot.triangle) Triangle(triangle_W(scene, slot.object, slot.index));  // in place
  slot.prepared = true;
}

const Nearest& CandidateSet::nearest(std::size_t i, const SceneObjects& scene) {
  Candidate& slot = slots_[i];
  if (is_measured(i)) {
    return slot.nearest;
  }
  slot.measured_at = places_;
  budget_.spend(kCostOfMeasurement);
  if (slot.primitive != nullptr) {
    measure_primitive(i);
    return slot.nearest;
  }
  prepare(slot, scene);
  // On a border the height is rounding where the sphere stands beside the triangle; its neighbour
  // across the border, or this one, must hold the sphere, so a nanometre behind still counts as in
  // front. On a face it does not: that is the far side.
  constexpr double kBesideBorder_m = -1e-9;
  ::new (&slot.nearest) Nearest(slot.triangle.nearest(place_));  // in place
  slot.behind =
      slot.one_sided && slot.triangle.height(place_) <
                            (slot.nearest.feature == Feature::face ? 0.0 : kBesideBorder_m);
  set_bound(i, slot.nearest.normal, slot.nearest.distance, place_);
  return slot.nearest;
}

// The distance is convex only outside a convex solid; every other primitive gets no bound.
void CandidateSet::measure_primitive(std::size_t i) {
  Candidate& slot = slots_[i];
  slot.seen = sample(*slot.primitive, place_);
  const bool inside = slot.seen.distance_m < 0.0;
  slot.behind = slot.one_sided && inside;
  slot.nearest = nearest_of(slot.seen);
  if (!inside && convex(*slot.primitive)) {
    set_bound(i, slot.nearest.normal, slot.nearest.distance, place_);
  } else {
    set_no_bound(i);
  }
}

}  // namespace tactus::rendering
