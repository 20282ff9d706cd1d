#include "host_tools/bake/scene/effect_writer.h"

#include <array>
#include <variant>

#include "rendering/effects/law_numbers.h"

namespace tactus::host {
namespace {

namespace image = rendering::image;
using flatbuffers::FlatBufferBuilder;
using flatbuffers::Offset;

image::Snap stored_snap(const rendering::SnapLaw& law) {
  return {law.stiffness_N_per_m, law.damping_Ns_per_m, law.capture_m};
}

// Writes a law into its table. The generic one is for laws without a table of their own.
class LawWriter {
 public:
  explicit LawWriter(FlatBufferBuilder& builder) : builder_(builder) {}

  Offset<void> operator()(const auto& law) const {
    const rendering::LawNumbers numbers = rendering::numbers_of(law);
    const auto name = builder_.CreateString(rendering::name_of(law));
    const auto values = builder_.CreateVector(numbers.values.data(), numbers.count);
    return image::CreateNamedLaw(builder_, name, values).Union();
  }
  Offset<void> operator()(const rendering::Spring& law) const {
    const image::Double3 anchor = stored(law.anchor_W);
    return image::CreateSpring(builder_, &anchor, law.stiffness_N_per_m).Union();
  }
  Offset<void> operator()(const rendering::SpringDamper& law) const {
    const image::Double3 anchor = stored(law.spring.anchor_W);
    return image::CreateSpringDamper(builder_, &anchor, law.spring.stiffness_N_per_m,
                                     law.damping_Ns_per_m)
        .Union();
  }
  Offset<void> operator()(const rendering::FluidDrag& law) const {
    const auto volume = write_primitive(builder_, law.volume);
    return image::CreateFluidDrag(builder_, volume, law.linear_Ns_per_m, law.quadratic_Ns2_per_m2,
                                  law.rim_m)
        .Union();
  }
  Offset<void> operator()(const rendering::Magnet& law) const {
    const image::Double3 pole = stored(law.pole_W);
    return image::CreateMagnet(builder_, &pole, law.strength_N, law.core_m).Union();
  }
  Offset<void> operator()(const rendering::ConstantField& law) const {
    const image::Double3 force = stored(law.force_W);
    return image::CreateConstantField(builder_, &force).Union();
  }
  Offset<void> operator()(const rendering::Vibration& law) const {
    const image::Double3 direction = stored(law.direction_W);
    return image::CreateVibration(builder_, &direction, law.amplitude_N, law.frequency_Hz).Union();
  }
  Offset<void> operator()(const rendering::StickSlip& law) const {
    return image::CreateStickSlip(builder_, law.stiffness_N_per_m, law.break_force_N).Union();
  }
  Offset<void> operator()(const rendering::SnapToPoint& law) const {
    const image::Double3 point = stored(law.point_W);
    const image::Snap snap = stored_snap(law.law);
    return image::CreateSnapToPoint(builder_, &point, &snap).Union();
  }
  Offset<void> operator()(const rendering::SnapToLine& law) const {
    const image::Double3 point = stored(law.point_W);
    const image::Double3 direction = stored(law.direction_W);
    const image::Snap snap = stored_snap(law.law);
    return image::CreateSnapToLine(builder_, &point, &direction, &snap).Union();
  }
  Offset<void> operator()(const rendering::SnapToPlane& law) const {
    const image::Double3 point = stored(law.point_W);
    const image::Double3 normal = stored(law.normal_W);
    const image::Snap snap = stored_snap(law.law);
    return image::CreateSnapToPlane(builder_, &point, &normal, &snap).Union();
  }

 private:
  FlatBufferBuilder& builder_;
};

// The laws with tables of their own, in the order of rendering::EffectLaw.
constexpr std::array kOwnTables{
    image::Law::Spring,      image::Law::SpringDamper,  image::Law::FluidDrag,
    image::Law::Magnet,      image::Law::ConstantField, image::Law::Vibration,
    image::Law::StickSlip,   image::Law::SnapToPoint,   image::Law::SnapToLine,
    image::Law::SnapToPlane,
};

image::Law table_of(const rendering::EffectLaw& law) {
  return law.index() < kOwnTables.size() ? kOwnTables[law.index()] : image::Law::NamedLaw;
}

}  // namespace

image::Double3 stored(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

image::Pose stored(const rendering::RigidPose& pose) {
  return {stored(Vec3{pose.rotation.col(0)}), stored(Vec3{pose.rotation.col(1)}),
          stored(Vec3{pose.rotation.col(2)}), stored(pose.translation)};
}

Offset<image::Primitive> write_primitive(FlatBufferBuilder& builder,
                                         const rendering::Primitive& primitive) {
  const image::Pose pose = stored(primitive.X_WO);
  const std::array<double, 3>& d = primitive.dimensions_m;
  const image::Double3 dimensions(d[0], d[1], d[2]);
  return image::CreatePrimitive(builder, static_cast<std::uint8_t>(primitive.kind), &pose,
                                &dimensions);
}

Offset<flatbuffers::Vector<Offset<image::Effect>>> write_effects(
    FlatBufferBuilder& builder, const std::vector<rendering::Effect>& effects) {
  std::vector<Offset<image::Effect>> list;
  for (const rendering::Effect& effect : effects) {
    const Offset<void> law = std::visit(LawWriter(builder), effect.law);
    list.push_back(image::CreateEffect(builder, table_of(effect.law), law, effect.max_force_N));
  }
  return list.empty() ? Offset<flatbuffers::Vector<Offset<image::Effect>>>{}
                      : builder.CreateVector(list);
}

}  // namespace tactus::host
