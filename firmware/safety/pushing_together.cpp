#include "firmware/safety/pushing_together.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "firmware/safety/stiffness_sum.h"
#include "rendering/limits.h"

namespace tactus::firmware {
namespace {

using rendering::Bounds;

// The most parts that a search looks at while a scene is loaded. Beyond it, as beyond kMostTogether
// members of a set, all parts that may push together with the set count as members. A look takes
// some 60 ns; preparing a scene of 1,024 objects takes 2 ms more.
constexpr std::size_t kMostLooks = std::size_t{1} << 16U;
// The same for a change of one object between two ticks of an active controller.
constexpr std::size_t kMostLooksOfSet = std::size_t{1} << 13U;

constexpr std::size_t kMostParts =
    rendering::kMaxObjects + rendering::kMaxEffects + FeltWalls::kCount;

// The sum of several stiffnesses may differ from the certified one by rounding.
constexpr double kSumRounding = 1e-9;

// The rounding of single precision at the ends of the world.
constexpr float kSlack_m = 2e-5F;

// A rough shape of a part, which separates most pairs.
struct Outline {
  // The corners of the surface, or of an effect's region, m.
  std::array<float, 3> lower{};
  std::array<float, 3> upper{};
  // The part is felt up to this distance from there, m.
  float reach_m = 0.0F;
  // The contact distance of the shared proxy's centre, m.
  float contact_m = 0.0F;
  bool shares_proxy = false;
  bool is_felt = false;
};

// Returns true if the part pushes at all.
bool is_felt(const ScenePart& part) {
  return part.felt.stiffness_N_per_m > 0.0 || part.felt.damping_Ns_per_m > 0.0;
}

// Returns the rough shape of a part.
Outline outline_of(const ScenePart& part) {
  Outline outline{.contact_m = static_cast<float>(part.contact_m),
                  .shares_proxy = part.shares_proxy,
                  .is_felt = is_felt(part)};
  const Bounds& region = part.region.box;
  const Bounds& box = part.shares_proxy ? part.surface : region;
  if (part.shares_proxy) {
    outline.reach_m = static_cast<float>((region.upper_W - box.upper_W).maxCoeff());
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    outline.lower[axis] = static_cast<float>(box.lower_W[static_cast<Eigen::Index>(axis)]);
    outline.upper[axis] = static_cast<float>(box.upper_W[static_cast<Eigen::Index>(axis)]);
  }
  return outline;
}

// Returns false only for a pair that never pushes together.
bool may_meet(const Outline& a, const Outline& b) {
  if (!a.is_felt || !b.is_felt) {
    return false;
  }
  const bool one_proxy = a.shares_proxy && b.shares_proxy;
  const float reach = one_proxy ? static_cast<float>(kSamePlace_m) : a.reach_m + b.reach_m;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (a.lower[axis] > b.upper[axis] + reach + kSlack_m ||
        b.lower[axis] > a.upper[axis] + reach + kSlack_m) {
      return false;
    }
  }
  if (!one_proxy) {
    return true;
  }
  // The two count together only if a side coincides.
  const float contact = a.contact_m - b.contact_m;
  constexpr float kNear_m = static_cast<float>(kSamePlace_m) + kSlack_m;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (std::abs(a.lower[axis] - b.lower[axis] - contact) < kNear_m ||
        std::abs(a.upper[axis] - b.upper[axis] + contact) < kNear_m) {
      return true;
    }
  }
  return false;
}

// Visits the sets of parts that can push together, each once, in the order of their numbers.
class Search {
 public:
  // The scene has at most kMostParts parts.
  Search(const StiffnessCertificate& certificate, const FeltScene& scene, std::size_t most_looks)
      : certificate_(certificate), scene_(scene), looks_left_(most_looks) {
    for (std::size_t i = 0; i < scene.size(); ++i) {
      outlines_[i] = outline_of(part_of(scene, i));
    }
  }

  // Checks the sets of part `first` and parts from `next` on. Returns true if one is beyond the
  // certificate.
  bool finds(std::size_t first, std::size_t next) {
    near_.count = 0;
    for (std::size_t i = next; i < scene_.size(); ++i) {
      if (i != first && may_meet(outlines_[first], outlines_[i])) {
        near_.numbers[near_.count++] = static_cast<std::uint16_t>(i);
      }
    }
    if (near_.count == 0) {
      return false;
    }
    set_.parts[0] = part_of(scene_, first);
    set_.numbers[0] = first;
    set_.count = 1;
    return is_felt(set_.parts[0]) && grow(0, set_.parts[0].region.box);
  }

  // Returns the set that finds() has found.
  [[nodiscard]] UncertifiedPart found() const {
    UncertifiedPart part{
        .stiffness_N_per_m = finding_.felt.stiffness_N_per_m,
        .damping_Ns_per_m = finding_.felt.damping_Ns_per_m,
        .limit_N_per_m = certified_stiffness(certificate_, finding_.felt.damping_Ns_per_m),
        .most_damping_Ns_per_m = certificate_.all().back().damping_Ns_per_m,
        .other_count = set_.count + finding_.unlisted - 1};
    const UncertifiedPart::Other first = name_of_part(scene_, set_.numbers[0]);
    part.kind = first.kind;
    part.index = first.index;
    part.listed = std::min(set_.count - 1, part.others.size());
    for (std::size_t i = 0; i < part.listed; ++i) {
      part.others[i] = name_of_part(scene_, set_.numbers[i + 1]);
    }
    // A wall of the workspace is always named. Walls come after all other parts of the scene.
    if (part.listed > 0 && set_.parts[set_.count - 1].is_wall) {
      part.others[part.listed - 1] = name_of_part(scene_, set_.numbers[set_.count - 1]);
    }
    return part;
  }

 private:
  // The parts that may push together with the first one, by their numbers in the scene.
  struct NearParts {
    std::array<std::uint16_t, kMostParts> numbers{};
    std::size_t count = 0;
  };
  // The set of parts that is looked at, and their numbers in the scene.
  struct PartSet {
    std::array<ScenePart, kMostTogether> parts{};
    std::array<std::size_t, kMostTogether> numbers{};
    std::size_t count = 0;
  };
  // The stiffness and damping of the set that was found.
  struct Finding {
    CertifiedPoint felt;
    // The number of parts that count in `felt` without being members of the set.
    std::size_t unlisted = 0;
  };
  // The parts that can push together with the set.
  struct Rest {
    CertifiedPoint felt;
    std::size_t count = 0;
  };

  [[nodiscard]] std::span<const ScenePart> members() const {
    return {set_.parts.data(), set_.count};
  }

  // Returns the stiffness and damping of the set in the box. Walls of the workspace stand at right
  // angles, so only one of their dampings counts.
  [[nodiscard]] CertifiedPoint felt_in(const Bounds& box) {
    CertifiedPoint sum;
    double of_wall = 0.0;
    for (const ScenePart& member : members()) {
      const double damping = member.felt.damping_Ns_per_m;
      sum.damping_Ns_per_m += member.is_wall ? 0.0 : damping;
      of_wall = member.is_wall ? damping : of_wall;
    }
    sum.damping_Ns_per_m += of_wall;
    const double enough = certified_stiffness(certificate_, sum.damping_Ns_per_m);
    sum.stiffness_N_per_m =
        (1.0 - kSumRounding) * stiffness_together(box, members(), enough, looks_left_);
    return sum;
  }

  // Returns true if the part pushes somewhere in the box together with the whole set.
  [[nodiscard]] bool fits(const ScenePart& part, const Bounds& box) const {
    const Bounds common = common_box(box, part.region.box);
    return is_felt(part) && has_point_in(common, part.region) &&
           std::ranges::all_of(members(), [&](const ScenePart& member) {
             return has_point_in(common, member.region) &&
                    (!member.shares_proxy || !part.shares_proxy || coincide(member, part));
           });
  }

  // Gets the part at `place` among those near the first. Returns false if it cannot push together
  // with the set.
  bool take(std::size_t place, const Bounds& box, ScenePart& part) {
    looks_left_ -= looks_left_ > 0 ? 1 : 0;
    part = part_of(scene_, near_.numbers[place]);
    return fits(part, box);
  }

  // Returns what all parts from place `next` on could add to the set.
  Rest rest_of(std::size_t next, const Bounds& box) {
    Rest rest;
    ScenePart part;
    for (std::size_t place = next; place < near_.count; ++place) {
      if (take(place, box, part)) {
        rest.felt.stiffness_N_per_m += stiffness_in(common_box(box, part.region.box), part);
        rest.felt.damping_Ns_per_m += part.felt.damping_Ns_per_m;
        ++rest.count;
      }
    }
    return rest;
  }

  // Returns true if no set of these parts and some of the rest can be beyond the certificate.
  [[nodiscard]] bool is_within(const CertifiedPoint& own, const CertifiedPoint& rest) const {
    return own.stiffness_N_per_m + rest.stiffness_N_per_m <=
           least_certified_stiffness(certificate_, own.damping_Ns_per_m,
                                     own.damping_Ns_per_m + rest.damping_Ns_per_m);
  }

  // Adds parts near the first one, from place `next` on, to the set, which pushes in the box.
  // Returns true if a set is beyond the certificate; the members are then that set.
  bool grow(std::size_t next, const Bounds& box) {
    const CertifiedPoint own = felt_in(box);
    const Rest rest = rest_of(next, box);
    if (rest.count == 0 || is_within(own, rest.felt)) {
      return false;
    }
    if (looks_left_ == 0 || set_.count == kMostTogether) {
      finding_.unlisted = rest.count;
      finding_.felt = {.damping_Ns_per_m = own.damping_Ns_per_m + rest.felt.damping_Ns_per_m,
                       .stiffness_N_per_m = own.stiffness_N_per_m + rest.felt.stiffness_N_per_m};
      return true;
    }
    for (std::size_t place = next; place < near_.count; ++place) {
      if (!take(place, box, set_.parts[set_.count])) {
        continue;
      }
      set_.numbers[set_.count++] = near_.numbers[place];
      const Bounds common = common_box(box, set_.parts[set_.count - 1].region.box);
      finding_.felt = felt_in(common);
      if (is_beyond(certificate_, finding_.felt) || grow(place + 1, common)) {
        return true;
      }
      --set_.count;
    }
    return false;
  }

  const StiffnessCertificate& certificate_;
  const FeltScene& scene_;
  std::array<Outline, kMostParts> outlines_{};
  NearParts near_;
  PartSet set_;
  Finding finding_;
  // The number of parts that the search may still look at.
  std::size_t looks_left_ = 0;
};

}  // namespace

std::optional<UncertifiedPart> first_uncertified_together(const StiffnessCertificate& certificate,
                                                          const FeltScene& scene) {
  Search search(certificate, scene, kMostLooks);
  for (std::size_t first = 0; first < scene.size(); ++first) {
    if (search.finds(first, first + 1)) {
      return search.found();
    }
  }
  return std::nullopt;
}

std::optional<UncertifiedPart> first_uncertified_with(const StiffnessCertificate& certificate,
                                                      const FeltScene& scene,
                                                      std::uint32_t object) {
  Search search(certificate, scene, kMostLooksOfSet);
  return search.finds(object, 0) ? std::optional(search.found()) : std::nullopt;
}

}  // namespace tactus::firmware
