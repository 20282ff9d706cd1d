#include "rendering/scene/shape_reader.h"

#include "rendering/scene/stored.h"

namespace tactus::rendering {
namespace {

using Result = std::expected<void, SceneError>;

static_assert(sizeof(Instruction) == sizeof(image::Instruction) && offsetof(Instruction, a) == 2 &&
              offsetof(Instruction, exponent) == 6 && offsetof(Instruction, constant) == 8);

// Returns true if the pose is a rotation to 1e-9, within the world.
bool is_pose(const RigidPose& pose) {
  constexpr double kTolerance = 1e-9;
  const Mat3 product = pose.rotation * pose.rotation.transpose();
  return (product - Mat3::Identity()).cwiseAbs().maxCoeff<Eigen::PropagateNaN>() <= kTolerance &&
         pose.rotation.determinant() > 0.0 &&
         pose.translation.cwiseAbs().maxCoeff<Eigen::PropagateNaN>() <= kWorldBound_m;
}

// Makes the object a primitive.
Result take_primitive(const image::Primitive& stored, Object& object) {
  const std::optional<Primitive> primitive = read_primitive(stored);
  if (!primitive) {
    return fail(SceneFault::shape);
  }
  object.surface = SurfaceKind::primitive;
  object.primitive = *primitive;
  return {};
}
// Makes the object an implicit surface. The instructions are used in place; check() proves that
// every operand is there, so that the evaluation needs no tests.
Result take_implicit(const image::Implicit& stored, Object& object) {
  if (!is_aligned(stored.instructions())) {
    return fail(SceneFault::malformed);
  }
  object.surface = SurfaceKind::implicit;
  ImplicitSurface& implicit = object.implicit;
  const RigidPose pose = to_pose(*stored.pose());
  implicit = {.formula = {in_place<Instruction>(stored.instructions())},
              .bounds_O = {.lower = to_vec3(*stored.lower()), .upper = to_vec3(*stored.upper())},
              .R_WO = pose.rotation,
              .p_WO = pose.translation,
              .scale_m = stored.scale(),
              .sides = object.sides};
  const Vec3 size = implicit.bounds_O.upper - implicit.bounds_O.lower;
  const bool in_range = is_pose(pose) && implicit.scale_m > 0.0 &&
                        implicit.scale_m <= kWorldBound_m && implicit.bounds_O.lower.allFinite() &&
                        size.allFinite() && size.minCoeff() > 0.0;
  if (!in_range) {
    return fail(SceneFault::shape);
  }
  if (const auto checked = check(implicit.formula); !checked) {
    return fail(SceneFault::formula, checked.error().place);
  }
  return {};
}

}  // namespace

std::optional<Primitive> read_primitive(const image::Primitive& stored) {
  Primitive primitive{.kind = static_cast<PrimitiveKind>(stored.kind()),
                      .X_WO = to_pose(*stored.pose()),
                      .dimensions_m = {stored.dimensions()->x(), stored.dimensions()->y(),
                                       stored.dimensions()->z()}};
  return valid(primitive) ? std::optional(primitive) : std::nullopt;
}

Result take_shape(const image::Object& stored, Object& object) {
  if (const image::Primitive* primitive = stored.shape_as_Primitive()) {
    return take_primitive(*primitive, object);
  }
  if (const image::Implicit* implicit = stored.shape_as_Implicit()) {
    return take_implicit(*implicit, object);
  }
  return stored.shape_type() == image::Shape::NONE ? Result{} : Result{fail(SceneFault::shape)};
}

}  // namespace tactus::rendering
