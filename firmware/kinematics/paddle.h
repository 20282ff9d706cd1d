// The one-axis paddle of the Hapkit: a handle on an arc. Pure functions for any thread; real time,
// except paddle_inverse.
//
// Frame D: origin on the paddle's axis, which is z; the handle is straight up, on +y, at joint 0,
// and moves to the right, to +x, as the joint grows. The joint is the angle of the paddle (of the
// sector that the capstan drives), rad. The bearing takes a force across the arc: it needs no
// effort.
#pragma once

#include <cmath>
#include <optional>
#include <span>

#include "drivers/common/setting.h"
#include "firmware/kinematics/link_weight.h"
#include "firmware/kinematics/pose.h"
#include "firmware/kinematics/range_check.h"
#include "rendering/geometry/portable_math.h"

namespace tactus::firmware {

// The dimensions of a paddle.
struct PaddleGeometry {
  // The distance from the axis to the handle, m. The default is that of Stanford's Hapkit.
  double handle_radius_m = 0.065659;
  // The weight of the paddle with its handle, from the axis to the handle.
  LinkWeight paddle;
};

inline void transfer(rendering::StateArchive& archive, PaddleGeometry& geometry) {
  auto& [handle_radius_m, paddle] = geometry;
  archive(handle_radius_m, paddle);
}

// Returns the pose, which is never singular. The second and third columns of the Jacobian are zero.
inline Pose paddle_forward(const PaddleGeometry& g, double joint) {
  const rendering::SineCosine turn = rendering::sine_cosine(joint);
  const double r = g.handle_radius_m;
  Pose pose{{r * turn.sine, r * turn.cosine, 0.0}, Mat3::Zero(), kPoseGood};
  pose.jacobian_D.col(0) << r * turn.cosine, -r * turn.sine, 0.0;
  return pose;
}

// Returns the joint at which the handle is nearest to p_D, -pi to pi; nothing for a point on the
// axis. Not part of the tick.
inline std::optional<double> paddle_inverse(const Vec3& p_D) {
  if (!(std::hypot(p_D.x(), p_D.y()) > 0.0)) {
    return std::nullopt;
  }
  return std::atan2(p_D.x(), p_D.y());
}

// Returns true if the paddle has a weight off its axis.
inline bool has_weight(const PaddleGeometry& g) {
  return g.paddle.moment_kg_m() != 0.0;
}

// Returns the effort that holds the paddle at `pose`, N m. `gravity_D` is in m/s^2.
inline double paddle_gravity_effort(const PaddleGeometry& g, const Pose& pose,
                                    const Vec3& gravity_D) {
  return -g.paddle.moment_kg_m() / g.handle_radius_m * pose.jacobian_D.col(0).dot(gravity_D);
}

// Checks every field. An error names the field after "mechanism.".
void check_geometry(RangeCheck& check, const PaddleGeometry& g);

class Paddle {
 public:
  using Geometry = PaddleGeometry;
  static constexpr std::size_t kJoints = 1;
  static constexpr bool kSlides = false;

  // The keys of [mechanism] in TOML.
  static std::span<const drivers::Binding<PaddleGeometry>> keys();

  explicit Paddle(const PaddleGeometry& geometry) : geometry_(geometry) {}

  [[nodiscard]] Pose forward(const Vec3& joints, const Vec3& /*seed_D*/) const {
    return paddle_forward(geometry_, joints.x());
  }
  [[nodiscard]] Vec3 gravity_effort(const Vec3& /*joints*/, const Pose& pose,
                                    const Vec3& gravity_D) const {
    return {paddle_gravity_effort(geometry_, pose, gravity_D), 0.0, 0.0};
  }

 private:
  PaddleGeometry geometry_;
};

}  // namespace tactus::firmware
