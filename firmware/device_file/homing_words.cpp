#include "firmware/device_file/homing_words.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <numbers>
#include <variant>

namespace tactus::firmware {
namespace {

using drivers::ReferenceKind;

constexpr std::size_t kMostLength = 96;

// Collects the instructions for homing, joint after joint.
class Instructions {
 public:
  Instructions(std::span<char> room, bool is_prismatic)
      : room_(room), is_prismatic_(is_prismatic) {}

  void add(const JointConfig& joint) {
    std::array<char, kMostLength> words{};
    const int name_length = static_cast<int>(joint.name.size());
    const char* const name = joint.name.data();
    const drivers::Reference& reference = joint.reference;
    if (reference.kind == ReferenceKind::known_pose) {
      const double place =
          is_prismatic_ ? 1e3 * reference.position : 180.0 / std::numbers::pi * reference.position;
      std::snprintf(words.data(), words.size(), "hold '%.*s' still at %.4g %s", name_length, name,
                    place, is_prismatic_ ? "mm" : "deg");
    } else if (reference.search_effort != 0.0) {
      std::snprintf(words.data(), words.size(), "let '%.*s' move by itself", name_length, name);
    } else if (reference.kind == ReferenceKind::index) {
      std::snprintf(words.data(), words.size(), "move '%.*s' past its index", name_length, name);
    } else if (reference.kind == ReferenceKind::board) {
      std::snprintf(words.data(), words.size(), "home '%.*s' at the device", name_length, name);
    } else {
      return;
    }
    const int wanted = std::snprintf(room_.data() + used_, room_.size() - used_, "%s%s",
                                     used_ == 0 ? "" : ", ", words.data());
    used_ = std::min(used_ + static_cast<std::size_t>(std::max(wanted, 0)),
                     room_.empty() ? 0 : room_.size() - 1);
  }

  [[nodiscard]] std::string_view words() const { return {room_.data(), used_}; }

 private:
  std::span<char> room_;
  bool is_prismatic_;
  std::size_t used_ = 0;
};

}  // namespace

std::string_view homing_words(const DeviceConfig& config, std::span<char> room) {
  Instructions instructions(room,
                            std::holds_alternative<CartesianGeometry>(config.controller.mechanism));
  for (const JointConfig& joint : std::span(config.joints).first(config.joint_count)) {
    instructions.add(joint);
  }
  return instructions.words();
}

}  // namespace tactus::firmware
