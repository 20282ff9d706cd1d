// Checks how a joint finds its reference after power-up, and whether its encoder allows that.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <variant>

#include "firmware/device_file/device_checks.h"

namespace tactus::firmware {

namespace {

using drivers::ReferenceKind;

constexpr double kTurn_rad = 2.0 * std::numbers::pi;
// The share of a turn that must be left beyond the joint's travel, since stops give and are only
// assumed.
constexpr double kMarginShare = 0.05;

// Returns the kinds of reference that fit the encoder's driver.
std::string_view fitting(const AxisConfig& encoder) {
  return drivers::visit_drive(
      encoder.drive, [&](const auto& driver, const auto& drive) -> std::string_view {
        if (driver.reference_advice != nullptr) {
          return driver.reference_advice(drive);
        }
        return encoder.encoder == EncoderKind::incremental
                   ? R"(its encoder counts from where it wakes up: "known_pose" or "hard_stop"; )"
                     R"(an absolute encoder is declared at the axis, encoder = "absolute_turn" or )"
                     R"("absolute")"
                   : R"(its encoder is absolute: "absolute", "known_pose" or "hard_stop")";
      });
}

bool fits(ReferenceKind kind, const AxisConfig& encoder) {
  return drivers::visit_drive(encoder.drive, [&](const auto& driver, const auto& drive) {
    if (driver.finds_own_reference) {
      return kind == ReferenceKind::board;
    }
    switch (kind) {
      case ReferenceKind::board:
        return false;
      case ReferenceKind::index:
        return driver.has_index != nullptr && driver.has_index(drive);
      case ReferenceKind::absolute:
        return encoder.encoder != EncoderKind::incremental;
      case ReferenceKind::hard_stop:
      case ReferenceKind::known_pose:
        break;
    }
    return true;
  });
}

drivers::EncoderFacts facts_of(const AxisConfig& encoder) {
  return drivers::visit_drive(
      encoder.drive, [](const auto& driver, const auto& /*drive*/) { return driver.encoder; });
}

// Returns true if the encoder knows its position within one turn only.
bool knows_one_turn_alone(const AxisConfig& encoder) {
  return encoder.encoder == EncoderKind::absolute_turn || facts_of(encoder).absolute_is_one_turn;
}

// Returns the reason why the axis is no encoder, or an empty text.
std::string_view no_encoder(const AxisConfig& axis) {
  return drivers::visit_drive(axis.drive, [](const auto& driver, const auto& drive) {
    return driver.no_encoder == nullptr ? std::string_view{} : driver.no_encoder(drive);
  });
}

bool is_sliding(const DeviceConfig& device) {
  return slides(device.controller.mechanism);
}

// Explains that one turn of the encoder is less than the joint's travel.
void say_ambiguous(const JointConfig& joint, std::string_view unit, Words& words) {
  const double ratio = joint.transmission.encoder_ratio;
  words.clear();
  words.add(R"("absolute" is ambiguous: one turn of the encoder is )")
      .add(kTurn_rad / ratio)
      .add(unit)
      .add(" of the joint (2 pi / encoder_ratio ")
      .add(ratio)
      .add("), which is not more than its travel of ")
      .add(joint.limits.upper - joint.limits.lower)
      .add(unit)
      .add(" (")
      .add(joint.limits.lower)
      .add(" to ")
      .add(joint.limits.upper)
      .add(") with a margin of 5 % of a turn, so after power-up it may be a turn off; write ")
      .add(
          R"(reference = "known_pose", "index" or "hard_stop", or put an absolute encoder at the )")
      .add("joint");
}

void say_begins_within(double low, double high, double begin, Words& words) {
  words.clear();
  words.add(R"("absolute" may be a turn off: over the joint's travel the encoder reads )")
      .add(low)
      .add(" to ")
      .add(high)
      .add(" rad, but after power-up its turn goes from ")
      .add(begin)
      .add(" to ")
      .add(begin + kTurn_rad)
      .add(
          " rad (5 % of a turn is kept as a margin); move the encoder's zero and the joint's "
          "offset with it, or say where the turn begins: encoder_turn_begins_rad at the axis");
}

Verdict check_absolute(const DeviceConfig& device, std::size_t i, Words& words) {
  const JointConfig& joint = device.joints[i];
  const AxisConfig& axis = device.axes[joint.encoder];
  if (joint.reference.kind != ReferenceKind::absolute || !knows_one_turn_alone(axis)) {
    return {};
  }
  const double first = encoder_position_rad(joint.transmission, joint.limits.lower);
  const double last = encoder_position_rad(joint.transmission, joint.limits.upper);
  const double low = std::min(first, last);
  const double high = std::max(first, last);
  const double margin = kMarginShare * kTurn_rad;
  if (!(high - low <= kTurn_rad - margin)) {
    say_ambiguous(joint, is_sliding(device) ? " m" : " rad", words);
    return std::unexpected(Refusal{Place::joint, i, "reference", words.view()});
  }
  const double begin = axis.encoder_turn_begins_rad.value_or(facts_of(axis).turn_begins_rad);
  if (low < begin + 0.5 * margin || high > begin + kTurn_rad - 0.5 * margin) {
    say_begins_within(low, high, begin, words);
    return std::unexpected(Refusal{Place::joint, i, "reference", words.view()});
  }
  return {};
}

Verdict check_reference(const DeviceConfig& device, std::size_t i, Words& words) {
  const JointConfig& joint = device.joints[i];
  const AxisConfig& encoder = device.axes[joint.encoder];
  words.clear();
  if (!joint.has_reference) {
    words.add("is missing, and has no default: it says how the joint learns where it is after ")
        .add(R"(power-up, "absolute", "board", "known_pose", "index" or "hard_stop"; )")
        .add(fitting(encoder));
    return std::unexpected(Refusal{Place::joint, i, "reference", words.view()});
  }
  if (!fits(joint.reference.kind, encoder)) {
    words.add("does not fit the encoder of axis \"")
        .add(encoder.name)
        .add("\"; ")
        .add(fitting(encoder));
    return std::unexpected(Refusal{Place::joint, i, "reference", words.view()});
  }
  if (const std::string_view reason = no_encoder(encoder); !reason.empty()) {
    words.add("is axis \"").add(encoder.name).add("\", ").add(reason);
    return std::unexpected(Refusal{Place::joint, i, "encoder", words.view()});
  }
  return check_absolute(device, i, words);
}

}  // namespace

Verdict check_references(const DeviceConfig& device, Words& words) {
  for (std::size_t i = 0; i < device.joint_count; ++i) {
    if (const Verdict verdict = check_reference(device, i, words); !verdict) {
      return verdict;
    }
  }
  return {};
}

}  // namespace tactus::firmware
