#include "firmware/safety/pushing_together.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

namespace tactus::firmware {
namespace {

using rendering::Bounds;

// Parts in one set, and sets that are looked at for each part to begin with. Beyond: all that may
// be felt with the set counts as felt with it.
constexpr std::size_t kMostTogether = 16;
constexpr std::size_t kMostSets = 2048;

// Sums of several stiffnesses differ from the certified one by rounding.
constexpr double kRounding = 1e-9;

// Goes through the sets of parts that can be felt together, each once, in order of their numbers.
class Search {
 public:
  Search(const StiffnessCertificate& certificate, const FeltScene& scene)
      : certificate_(certificate), scene_(scene) {}

  // Of the sets of part `first` and parts from `next` on; true if one is beyond the certificate.
  bool finds(std::size_t first, std::size_t next) {
    members_[0] = part_of(scene_, first);
    numbers_[0] = first;
    count_ = 1;
    sets_ = 0;
    unlisted_ = 0;
    return is_felt(members_[0]) && grow(next, members_[0].region.box);
  }

  [[nodiscard]] UncertifiedPart found() const {
    UncertifiedPart part{.stiffness_N_per_m = felt_.stiffness_N_per_m,
                         .damping_Ns_per_m = felt_.damping_Ns_per_m,
                         .limit_N_per_m = certified_stiffness(certificate_, felt_.damping_Ns_per_m),
                         .most_damping_Ns_per_m = certificate_.all().back().damping_Ns_per_m,
                         .other_count = count_ + unlisted_ - 1};
    const UncertifiedPart::Other first = name_of(numbers_[0]);
    part.kind = first.kind;
    part.index = first.index;
    part.listed = std::min(count_ - 1, part.others.size());
    for (std::size_t i = 0; i < part.listed; ++i) {
      part.others[i] = name_of(numbers_[i + 1]);
    }
    return part;
  }

 private:
  // What can be felt with the set.
  struct Rest {
    CertifiedPoint felt;
    std::size_t count = 0;
  };

  static bool is_felt(const ScenePart& part) {
    return part.felt.stiffness_N_per_m > 0.0 || part.felt.damping_Ns_per_m > 0.0;
  }

  [[nodiscard]] UncertifiedPart::Other name_of(std::size_t number) const {
    const std::size_t objects = scene_.objects.size();
    if (number < objects) {
      return {UncertifiedPart::Kind::object, number};
    }
    return {UncertifiedPart::Kind::effect, number - objects};
  }

  [[nodiscard]] std::span<const ScenePart> members() const { return {members_.data(), count_}; }

  // The set's own.
  [[nodiscard]] CertifiedPoint felt() const {
    CertifiedPoint sum{.stiffness_N_per_m = (1.0 - kRounding) * stiffness_together(members())};
    for (const ScenePart& member : members()) {
      sum.damping_Ns_per_m += member.felt.damping_Ns_per_m;
    }
    return sum;
  }

  // Whether the part is felt somewhere in the box, together with all of the set.
  [[nodiscard]] bool fits(const ScenePart& part, const Bounds& box) const {
    const Bounds common = common_box(box, part.region.box);
    return is_felt(part) && has_point_in(common, part.region) &&
           std::ranges::all_of(members(), [&](const ScenePart& member) {
             return has_point_in(common, member.region) &&
                    (!member.shares_proxy || !part.shares_proxy || coincide(member, part));
           });
  }

  // Part `number`, if it can be felt with the set.
  bool take(std::size_t number, const Bounds& box, ScenePart& part) const {
    if (number == numbers_[0]) {
      return false;
    }
    part = part_of(scene_, number);
    return fits(part, box);
  }

  [[nodiscard]] Rest rest_of(std::size_t next, const Bounds& box) const {
    Rest rest;
    ScenePart part;
    for (std::size_t i = next; i < scene_.size(); ++i) {
      if (take(i, box, part)) {
        rest.felt.stiffness_N_per_m += part.felt.stiffness_N_per_m;
        rest.felt.damping_Ns_per_m += part.felt.damping_Ns_per_m;
        ++rest.count;
      }
    }
    return rest;
  }

  // Whether no set of these parts and some of the rest can be beyond the certificate.
  [[nodiscard]] bool is_within(const CertifiedPoint& own, const CertifiedPoint& rest) const {
    return own.stiffness_N_per_m + rest.stiffness_N_per_m <=
           least_certified_stiffness(certificate_, own.damping_Ns_per_m,
                                     own.damping_Ns_per_m + rest.damping_Ns_per_m);
  }

  // Adds parts from `next` on to the set, which is felt in the box.
  bool grow(std::size_t next, const Bounds& box) {
    const CertifiedPoint own = felt();
    const Rest rest = rest_of(next, box);
    if (rest.count == 0 || is_within(own, rest.felt)) {
      return false;
    }
    if (++sets_ > kMostSets || count_ == kMostTogether) {
      unlisted_ = rest.count;
      felt_ = {.damping_Ns_per_m = own.damping_Ns_per_m + rest.felt.damping_Ns_per_m,
               .stiffness_N_per_m = own.stiffness_N_per_m + rest.felt.stiffness_N_per_m};
      return true;
    }
    for (std::size_t i = next; i < scene_.size(); ++i) {
      ScenePart& part = members_[count_];
      if (!take(i, box, part)) {
        continue;
      }
      numbers_[count_++] = i;
      felt_ = felt();
      if (is_beyond(certificate_, felt_) ||
          grow(i + 1, common_box(box, members_[count_ - 1].region.box))) {
        return true;
      }
      --count_;
    }
    return false;
  }

  const StiffnessCertificate& certificate_;
  const FeltScene& scene_;
  std::array<ScenePart, kMostTogether> members_{};
  std::array<std::size_t, kMostTogether> numbers_{};
  std::size_t count_ = 0;
  std::size_t sets_ = 0;
  std::size_t unlisted_ = 0;  // parts that count in `felt_` without being members
  CertifiedPoint felt_;       // of the set that was found
};

}  // namespace

std::optional<UncertifiedPart> first_uncertified_together(const StiffnessCertificate& certificate,
                                                          const FeltScene& scene) {
  Search search(certificate, scene);
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
  Search search(certificate, scene);
  return search.finds(object, 0) ? std::optional(search.found()) : std::nullopt;
}

}  // namespace tactus::firmware
