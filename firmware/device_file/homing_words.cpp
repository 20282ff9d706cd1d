#include "firmware/device_file/homing_words.h"

#include <span>
#include <string_view>
#include <variant>

#include "hal/angle.h"

namespace tactus::firmware {
namespace {

using drivers::ReferenceKind;

// The verb and the rest of one joint's instruction, about its name; both empty: there is none.
struct Instruction {
  std::string_view before;
  std::string_view after;
};

Instruction instruction_for(const drivers::Reference& reference) {
  if (reference.kind == ReferenceKind::known_pose) {
    return {.before = "hold '", .after = "' still at "};
  }
  if (reference.search_effort != 0.0) {
    return {.before = "let '", .after = "' move by itself"};
  }
  if (reference.kind == ReferenceKind::index) {
    return {.before = "move '", .after = "' past its index"};
  }
  if (reference.kind == ReferenceKind::board) {
    return {.before = "home '", .after = "' at the device"};
  }
  return {};
}

}  // namespace

void add_homing_words(const DeviceConfig& config, Words& words) {
  constexpr int kDecimals = 2;
  const bool is_prismatic = slides(config.controller.mechanism);
  const double shown_per_unit = is_prismatic ? 1e3 : hal::degrees_of(1.0);
  std::string_view separator;
  for (const JointConfig& joint : std::span(config.joints).first(config.joint_count)) {
    const Instruction instruction = instruction_for(joint.reference);
    if (instruction.before.empty()) {
      continue;
    }
    words.add(separator).add(instruction.before).add(joint.name).add(instruction.after);
    if (joint.reference.kind == ReferenceKind::known_pose) {
      words.add(shown_per_unit * joint.reference.position, kDecimals)
          .add(is_prismatic ? " mm" : " deg");
    }
    separator = ", ";
  }
}

}  // namespace tactus::firmware
