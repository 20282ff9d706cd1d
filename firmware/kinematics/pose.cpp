#include "firmware/kinematics/pose.h"

#include <Eigen/LU>

namespace tactus::firmware {
namespace {

// Returns a unit vector perpendicular to `v`.
Vec3 square_to(const Vec3& v) {
  Eigen::Index flattest = 0;
  v.cwiseAbs().minCoeff(&flattest);
  return v.cross(Vec3::Unit(flattest)).normalized();
}

}  // namespace

// Solves effort = J^T f. The column of a missing joint is replaced by a direction in which the tool
// cannot move; the force along it is zero.
Vec3 tool_force(const Pose& pose, const Vec3& effort, std::size_t joint_count) {
  Mat3 columns = pose.jacobian_D;
  Vec3 known = effort;
  if (joint_count < 2) {
    columns.col(1) = square_to(columns.col(0));
    known.y() = 0.0;
  }
  if (joint_count < 3) {
    columns.col(2) = columns.col(0).cross(columns.col(1)).normalized();
    known.z() = 0.0;
  }
  return columns.transpose().inverse() * known;
}

}  // namespace tactus::firmware
