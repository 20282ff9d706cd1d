// The fields of the effect laws, described once: the key in TOML, its unit, range and whether it
// may be left out. Reading TOML, checking a law, and storing it in an image all go by these.
//
//   template <class Law, class Visitor>
//   static void visit_fields(Law& law, Visitor& visit) {  // of a law, const or not
//     visit(kPositionField, law.pole_W);
//     visit(NumberField{.key = "strength_N", .unit = "N", .range = FieldRange::any, .example =
//     "2.0"},
//           law.strength_N);
//   }
#pragma once

#include <cstdint>
#include <string_view>

namespace tactus::rendering {

enum class FieldRange : std::uint8_t { any, zero_or_more, above_zero };

// A `double`. `unit` is the suffix of the key that says it, empty without one.
struct NumberField {
  std::string_view key;
  std::string_view unit;
  FieldRange range = FieldRange::zero_or_more;
  std::string_view example;  // empty: the key may be left out, and the law's own value stands
};

enum class VectorUse : std::uint8_t {
  place,     // may be left out
  quantity,  // any vector, such as a force
  direction  // not zero; the law has it as a unit vector
};

// A `Vec3` in the world frame.
struct VectorField {
  std::string_view key;
  std::string_view unit;
  VectorUse use = VectorUse::place;
  std::string_view example;  // of a quantity or a direction
};

// A `Primitive` in the world frame: its keys are those of an object's primitive, with position_m
// and rotation.
struct VolumeField {};

// Fields that several laws have. A stiffness must be given; damping may be left out.
inline constexpr VectorField kPositionField{.key = "position_m", .unit = "m"};
inline constexpr VectorField kDirectionField{
    .key = "direction", .use = VectorUse::direction, .example = "[0.0, 1.0, 0.0]"};
inline constexpr NumberField kStiffnessField{
    .key = "stiffness_N_per_m", .unit = "N_per_m", .example = "200.0"};
inline constexpr NumberField kDampingField{.key = "damping_Ns_per_m", .unit = "Ns_per_m"};

}  // namespace tactus::rendering
