// Bodies at rest are not computed: they sleep. Bodies that touch each other are an island, which
// sleeps and wakes as one. An island falls asleep when all of its bodies have been still for a
// time: no point of them faster than kSleepSpeed_m_per_s, no finger on them, and no obstacle that
// moves. It wakes when a finger, a body that is awake or a moving obstacle touches one of its
// bodies, or when the gravity changes. BodyWorld decides who touches whom.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "rendering/bodies/body_contact.h"
#include "rendering/limits.h"
#include "rendering/state_archive.h"

namespace tactus::rendering {

// A body whose points are all slower is still, m/s.
inline constexpr double kSleepSpeed_m_per_s = 1e-6;

// The bodies that sleep, and the contacts with which they go on when they wake.
class BodySleep {
 public:
  // Starts over with all bodies awake. They fall asleep after `after_s` of rest, s; 0: never.
  void start(double after_s);

  // Returns true if bodies may fall asleep.
  [[nodiscard]] bool is_on() const { return after_s_ > 0.0; }
  [[nodiscard]] bool is_asleep(std::size_t body) const { return island_[body] != kAwake; }
  // Returns true if both are asleep in one island.
  [[nodiscard]] bool is_one_island(std::size_t body, std::size_t other) const {
    return is_asleep(body) && island_[body] == island_[other];
  }
  // Returns true if a contact with the obstacle, a number in the solver's list, is kept for a body
  // that sleeps.
  [[nodiscard]] bool rests_on(std::size_t body, std::uint16_t obstacle) const;

  // Wakes a body with its island, or all bodies.
  void wake(std::size_t body);
  void wake_all();

  // Adds the kept contacts of bodies that are awake now to `contacts`, which has room for
  // kMaxBodyContacts more, and forgets them. Returns how many they are.
  std::size_t take_contacts(std::span<PastContact> contacts);

  // Counts the rest of a body that is awake in a tick: its time begins anew if it is not still.
  void count_rest(std::size_t body, bool is_still, double tick_s) {
    still_s_[body] = is_still ? still_s_[body] + tick_s : 0.0;
  }

  // Lets islands of the first `bodies` fall asleep that have been still for long enough, and keeps
  // their contacts. An island whose contacts find no room stays awake. Returns true if any did.
  bool fall_asleep(std::size_t bodies, std::span<const BodyContact> contacts);

  // Saves the state to the archive, or restores it. `solids` is one more than the largest number of
  // a solid.
  void transfer(StateArchive& archive, std::uint16_t bodies, std::uint16_t solids);

 private:
  static constexpr std::uint8_t kAwake = 0xff;
  static_assert(kMaxBodies < kAwake);

  double after_s_ = 0.0;
  // The time for which each body has been still, s.
  std::array<double, kMaxBodies> still_s_{};
  // The island in which each body sleeps: the smallest number of its bodies; kAwake.
  std::array<std::uint8_t, kMaxBodies> island_{};
  std::array<PastContact, kMaxBodyContacts> contacts_;
  std::size_t contact_count_ = 0;
};

}  // namespace tactus::rendering
