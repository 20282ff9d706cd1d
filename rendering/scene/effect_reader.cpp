#include "rendering/scene/effect_reader.h"

#include <algorithm>
#include <cstring>

#include "rendering/effects/law_numbers.h"
#include "rendering/scene/shape_reader.h"
#include "rendering/scene/stored.h"

namespace tactus::rendering {
namespace {

using Law = std::optional<EffectLaw>;

// Returns the common part of the three laws that snap.
SnapLaw to_snap(const image::Snap& stored) {
  return {.stiffness_N_per_m = stored.stiffness(),
          .damping_Ns_per_m = stored.damping(),
          .capture_m = stored.capture()};
}

// Read one law each. The verifier has proved the required fields to be there.
Law read_law(const image::Spring& stored) {
  return Spring{.anchor_W = to_vec3(*stored.anchor()), .stiffness_N_per_m = stored.stiffness()};
}

Law read_law(const image::SpringDamper& stored) {
  return SpringDamper{
      .spring = {.anchor_W = to_vec3(*stored.anchor()), .stiffness_N_per_m = stored.stiffness()},
      .damping_Ns_per_m = stored.damping()};
}

// The volume of a drag may be refused; then there is no law.
Law read_law(const image::FluidDrag& stored) {
  const std::optional<Primitive> volume = read_primitive(*stored.volume());
  if (!volume) {
    return std::nullopt;
  }
  return FluidDrag{.volume = *volume,
                   .linear_Ns_per_m = stored.linear(),
                   .quadratic_Ns2_per_m2 = stored.quadratic(),
                   .rim_m = stored.rim()};
}

Law read_law(const image::Magnet& stored) {
  return Magnet{
      .pole_W = to_vec3(*stored.pole()), .strength_N = stored.strength(), .core_m = stored.core()};
}

Law read_law(const image::ConstantField& stored) {
  return ConstantField{.force_W = to_vec3(*stored.force())};
}

Law read_law(const image::Vibration& stored) {
  return Vibration{.direction_W = to_vec3(*stored.direction()),
                   .amplitude_N = stored.amplitude(),
                   .frequency_Hz = stored.frequency()};
}

Law read_law(const image::StickSlip& stored) {
  return StickSlip{.stiffness_N_per_m = stored.stiffness(), .break_force_N = stored.break_force()};
}

Law read_law(const image::SnapToPoint& stored) {
  return SnapToPoint{.point_W = to_vec3(*stored.point()), .law = to_snap(*stored.snap())};
}

Law read_law(const image::SnapToLine& stored) {
  return SnapToLine{.point_W = to_vec3(*stored.point()),
                    .direction_W = to_vec3(*stored.direction()),
                    .law = to_snap(*stored.snap())};
}

Law read_law(const image::SnapToPlane& stored) {
  return SnapToPlane{.point_W = to_vec3(*stored.point()),
                     .normal_W = to_vec3(*stored.normal()),
                     .law = to_snap(*stored.snap())};
}

// The numbers are copied, since they need not be aligned.
Law read_law(const image::NamedLaw& stored) {
  LawNumbers numbers;
  numbers.count = std::min<std::size_t>(stored.numbers()->size(), kMostLawNumbers);
  std::memcpy(numbers.values.data(), stored.numbers()->Data(), numbers.count * sizeof(double));
  return law_of(stored.name()->string_view(), numbers.all());
}

// Returns the name of a law that is not registered, empty for others.
std::string_view unknown_name(const image::Effect& stored) {
  const image::NamedLaw* const law = stored.law_as_NamedLaw();
  if (law == nullptr) {
    return {};
  }
  const std::string_view name = law->name()->string_view();
  return std::ranges::find(kEffectLawNames, name) == kEffectLawNames.end() ? name
                                                                           : std::string_view{};
}

// Returns the law of the stored effect if it is of this type.
template <class Stored>
Law read_law_as(const image::Effect& stored) {
  const Stored* const law = stored.law_as<Stored>();
  return law == nullptr ? std::nullopt : read_law(*law);
}

// Returns the law by its tag; nothing if this program does not know it.
Law read_law(const image::Effect& stored) {
  switch (stored.law_type()) {
    case image::Law::Spring:
      return read_law_as<image::Spring>(stored);
    case image::Law::SpringDamper:
      return read_law_as<image::SpringDamper>(stored);
    case image::Law::FluidDrag:
      return read_law_as<image::FluidDrag>(stored);
    case image::Law::Magnet:
      return read_law_as<image::Magnet>(stored);
    case image::Law::ConstantField:
      return read_law_as<image::ConstantField>(stored);
    case image::Law::Vibration:
      return read_law_as<image::Vibration>(stored);
    case image::Law::StickSlip:
      return read_law_as<image::StickSlip>(stored);
    case image::Law::SnapToPoint:
      return read_law_as<image::SnapToPoint>(stored);
    case image::Law::SnapToLine:
      return read_law_as<image::SnapToLine>(stored);
    case image::Law::SnapToPlane:
      return read_law_as<image::SnapToPlane>(stored);
    case image::Law::NamedLaw:
      return read_law_as<image::NamedLaw>(stored);
    default:
      return std::nullopt;
  }
}

}  // namespace

std::expected<Effect, SceneError> read_effect(const image::Effect& stored) {
  if (const std::string_view name = unknown_name(stored); !name.empty()) {
    return std::unexpected(SceneError{.fault = SceneFault::effect_law, .name = FaultName(name)});
  }
  const Law law = read_law(stored);
  Effect effect{.law = law.value_or(EffectLaw{}), .max_force_N = stored.max_force()};
  if (!law || !valid(effect)) {
    return std::unexpected(SceneError{.fault = SceneFault::effect});
  }
  return effect;
}

}  // namespace tactus::rendering
