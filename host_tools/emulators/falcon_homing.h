// The references of an emulated Falcon's arms: which arms have found theirs, and where each arm
// counts from.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "host_tools/emulators/shaft.h"

namespace tactus::host {

// The homing of all arms. Angles are those of the arms from the base plane.
class FalconHoming {
 public:
  static constexpr std::size_t kArms = 3;

  // `homed` is true if all arms know their reference from the start.
  explicit FalconHoming(bool homed) : homed_(homed ? std::uint8_t{7} : std::uint8_t{0}) {}

  // Takes the arms at a command. If it is the first, they count from here until they are homed. If
  // the command asks to home, an arm that has been pulled out and then pushed in becomes homed.
  void watch(std::span<const EmulatedShaft, kArms> arms, bool is_asked);

  // Makes all arms forget their reference; those that were pulled out need only be pushed in.
  void forget_references() { homed_ = 0; }
  // Makes all arms forget their reference and that they were pulled out.
  void start_again();
  // The same, and the arms count from where they are at the next command.
  void lose_power();

  // Returns one bit for each arm that knows its reference.
  [[nodiscard]] std::uint8_t homed() const { return homed_; }
  // Returns the count of an arm's encoder at this angle.
  [[nodiscard]] int count(std::size_t arm, double position_rad) const;

 private:
  std::uint8_t homed_;
  // True once the arm has been pulled out, which is the first half of homing.
  std::array<bool, kArms> was_out_{};
  // The arms' angles at the first command, rad.
  std::array<double, kArms> origin_rad_{};
  bool origin_known_ = false;
};

}  // namespace tactus::host
