#include "rendering/bodies/body_sleep.h"

#include <algorithm>

namespace tactus::rendering {
namespace {

// The islands of bodies that touch each other: each body leads to the smallest of its island.
class Islands {
 public:
  Islands(std::size_t bodies, std::span<const BodyContact> contacts) {
    for (std::size_t i = 0; i < kMaxBodies; ++i) {
      smaller_[i] = static_cast<std::uint8_t>(i);
    }
    for (const BodyContact& contact : contacts) {
      if (contact.a < bodies) {
        const std::uint8_t a = smallest(contact.a);
        const std::uint8_t b = smallest(contact.b);
        smaller_[std::max(a, b)] = std::min(a, b);
      }
    }
  }

  [[nodiscard]] std::uint8_t smallest(std::size_t body) const {
    while (smaller_[body] != body) {
      body = smaller_[body];
    }
    return static_cast<std::uint8_t>(body);
  }

 private:
  std::array<std::uint8_t, kMaxBodies> smaller_{};
};

}  // namespace

void BodySleep::start(double after_s) {
  after_s_ = after_s;
  contact_count_ = 0;
  wake_all();
}

void BodySleep::wake_all() {
  still_s_.fill(0.0);
  island_.fill(kAwake);
}

void BodySleep::wake(std::size_t body) {
  const std::uint8_t island = island_[body];
  for (std::size_t i = 0; island != kAwake && i < kMaxBodies; ++i) {
    if (island_[i] == island) {
      island_[i] = kAwake;
      still_s_[i] = 0.0;
    }
  }
}

bool BodySleep::rests_on(std::size_t body, std::uint16_t obstacle) const {
  return std::ranges::any_of(
      std::span(contacts_).first(contact_count_),
      [&](const PastContact& contact) { return contact.a == obstacle && contact.b == body; });
}

std::size_t BodySleep::take_contacts(std::span<PastContact> contacts) {
  std::size_t taken = 0;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < contact_count_; ++i) {
    if (is_asleep(contacts_[i].b)) {
      contacts_[kept++] = contacts_[i];
    } else {
      contacts[taken++] = contacts_[i];
    }
  }
  contact_count_ = kept;
  return taken;
}

bool BodySleep::fall_asleep(std::size_t bodies, std::span<const BodyContact> contacts) {
  const auto is_ready = [&](std::size_t i) { return !is_asleep(i) && still_s_[i] >= after_s_; };
  bool any_ready = false;
  for (std::size_t i = 0; i < bodies; ++i) {
    any_ready = any_ready || is_ready(i);
  }
  if (!any_ready) {
    return false;
  }
  const Islands islands(bodies, contacts);
  std::array<bool, kMaxBodies> sleeps{};
  sleeps.fill(true);
  for (std::size_t i = 0; i < bodies; ++i) {
    const std::uint8_t island = islands.smallest(i);
    sleeps[island] = sleeps[island] && is_ready(i);
  }
  bool any = false;
  for (std::size_t island = 0; island < bodies; ++island) {
    const auto is_here = [&](std::size_t body) { return islands.smallest(body) == island; };
    const auto count = static_cast<std::size_t>(std::ranges::count_if(
        contacts, [&](const BodyContact& contact) { return is_here(contact.b); }));
    if (!is_here(island) || !sleeps[island] || contact_count_ + count > kMaxBodyContacts) {
      continue;
    }
    any = true;
    for (const BodyContact& contact : contacts) {
      if (is_here(contact.b)) {
        contacts_[contact_count_++] = past_of(contact);
      }
    }
    for (std::size_t i = 0; i < bodies; ++i) {
      island_[i] = is_here(i) ? static_cast<std::uint8_t>(island) : island_[i];
    }
  }
  return any;
}

}  // namespace tactus::rendering
