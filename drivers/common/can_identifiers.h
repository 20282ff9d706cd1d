// The identifiers that a drive on a CAN bus sends, obeys or listens to.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace tactus::drivers {

// An identifier of 11 bits, or of 29 bits if extended.
struct CanIdentifier {
  std::uint32_t id = 0;
  bool extended = false;

  bool operator==(const CanIdentifier&) const = default;
};

// Keeps as many identifiers as a drive may have and drops the rest.
class CanIdentifiers {
 public:
  void add_standard(std::uint32_t id) { add({id, false}); }
  void add_extended(std::uint32_t id) { add({id, true}); }
  [[nodiscard]] std::span<const CanIdentifier> all() const { return {ids_.data(), count_}; }

 private:
  void add(const CanIdentifier& identifier) {
    if (count_ < ids_.size()) {
      ids_[count_] = identifier;
      ++count_;
    }
  }

  std::array<CanIdentifier, 72> ids_{};
  std::size_t count_ = 0;
};

}  // namespace tactus::drivers
