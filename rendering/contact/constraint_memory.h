// The constraints that the proxy met earlier in the same tick. They keep its straight moves from
// going round in a cycle. Every sub-goal leaves them to the next (proxy_tick.cpp).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "rendering/contact/contact_planes.h"
#include "rendering/contact/proxy_rest.h"
#include "rendering/limits.h"

namespace tactus::rendering {

// It holds numbers of candidates, so it is valid until the candidates are gathered again.
class ConstraintMemory {
 public:
  // Forgets everything. Call it when the candidates are gathered again, which gives them new
  // numbers.
  void clear() { held_count_ = recalled_count_ = blocking_count_ = 0; }

  // Remembers that the first `count` planes of `rest` held the proxy at `p`, which it leaves now.
  void leave(const Vec3& p, const ProxyRest& rest, std::size_t count);

  // Returns the place that the proxy left last; world frame, m.
  [[nodiscard]] const Vec3& left_from() const { return left_from_; }

  // Returns true if the move from `p` to `goal` would begin a cycle; `h` is the tool.
  //
  // In a flat valley the proxy can move back and forth within the contact margin: on either side it
  // does not touch the other, and the nearest point of each plane lies beyond it. The move would
  // return to the place that the proxy has just left, or end no nearer to the tool than there.
  [[nodiscard]] bool would_cycle(const Vec3& p, const Vec3& goal, const Vec3& h) const;

  // Makes the candidates that held the proxy at the place it left give planes from any distance,
  // until the tick ends. Returns true if there is one that is not among `planes`.
  bool recall(const ContactPlanes& planes);

  // Returns the candidates that give planes from any distance.
  [[nodiscard]] std::span<const std::uint16_t> recalled() const {
    return {recalled_.data(), recalled_count_};
  }

  // Remembers that a candidate stopped a sweep in this tick.
  void add_blocking(std::size_t candidate);
  // Returns true if the candidate stopped a sweep in this tick.
  [[nodiscard]] bool is_blocking(std::size_t candidate) const {
    const auto blocking = std::span(blocking_).first(blocking_count_);
    return std::ranges::find(blocking, candidate) != blocking.end();
  }

 private:
  // The candidates that held the proxy at the place it left last, the first `held_count_`.
  std::array<std::uint16_t, 3> held_by_{};
  std::size_t held_count_ = 0;
  // The place that the proxy left last; world frame, m.
  Vec3 left_from_ = Vec3::Zero();
  // The candidates that give planes from any distance; beyond their number none is added.
  std::array<std::uint16_t, 12> recalled_{};
  std::size_t recalled_count_ = 0;
  // The candidates that stopped a sweep; beyond their number none is added.
  std::array<std::uint16_t, kMaxContactPlanes> blocking_{};
  std::size_t blocking_count_ = 0;
};

}  // namespace tactus::rendering
