#include "rendering/profiles/scene_capacity.h"

#include <algorithm>
#include <charconv>
#include <ranges>

#include "rendering/profiles/chosen_profile.h"

namespace tactus::rendering {
namespace {

static_assert(std::ranges::all_of(kProfiles,
                                  [](const CapacityProfile& each) { return is_sound(each); }),
              "a profile breaks a bound of capacity_profile.h, or has left out a size");

// Words behind each other in a room, cut at its end.
class CutWords {
 public:
  explicit CutWords(std::span<char> room) : room_(room) {}

  CutWords& add(std::string_view words) {
    const std::size_t count = std::min(words.size(), room_.size() - size_);
    std::ranges::copy(words.substr(0, count), room_.begin() + static_cast<std::ptrdiff_t>(size_));
    size_ += count;
    return *this;
  }
  CutWords& add(std::size_t number) {
    std::array<char, 20> digits{};
    const auto end = std::to_chars(digits.begin(), digits.end(), number).ptr;
    return add(std::string_view(digits.begin(), end));
  }

  [[nodiscard]] std::string_view words() const { return {room_.data(), size_}; }

 private:
  std::span<char> room_;
  std::size_t size_ = 0;
};

// Returns the smallest profile that has room for so much, or nullptr.
const CapacityProfile* profile_with_room(const ExceededCapacity& capacity) {
  const auto* const entry =
      std::ranges::find(kSceneCapacities, capacity.name, &SceneCapacity::name);
  if (entry == kSceneCapacities.end()) {
    return nullptr;
  }
  const auto smallest_first = kProfiles | std::views::reverse;
  const auto found = std::ranges::find_if(smallest_first, [&](const CapacityProfile& profile) {
    return profile.*(entry->limit) >= capacity.count;
  });
  return found == smallest_first.end() ? nullptr : &*found;
}

}  // namespace

std::optional<ExceededCapacity> exceeded(const SceneCapacity& capacity, const SceneCounts& counts,
                                         const CapacityProfile& profile) {
  const std::size_t count = counts.*capacity.count;
  const std::size_t limit = profile.*capacity.limit;
  if (count <= limit) {
    return std::nullopt;
  }
  return ExceededCapacity{
      .name = capacity.name, .noun = capacity.noun, .count = count, .limit = limit};
}

std::optional<ExceededCapacity> first_exceeded(const SceneCounts& counts,
                                               const CapacityProfile& profile) {
  for (const SceneCapacity& capacity : kSceneCapacities) {
    if (const auto found = exceeded(capacity, counts, profile)) {
      return found;
    }
  }
  return std::nullopt;
}

std::string_view exceeded_words(const ExceededCapacity& capacity, std::span<char> room) {
  CutWords text(room);
  text.add(capacity.count).add(" ").add(capacity.noun).add(", where ").add(capacity.limit);
  text.add(capacity.limit == 1 ? " fits" : " fit")
      .add(" (profile ")
      .add(kProfile.name)
      .add("); leave some out, or ");
  if (const CapacityProfile* const larger = profile_with_room(capacity); larger != nullptr) {
    text.add("build this program with -D TACTUS_PROFILE=").add(larger->name);
  } else {
    text.add("raise ").add(capacity.name).add(" in a header of rendering/profiles and build again");
  }
  return text.words();
}

}  // namespace tactus::rendering
