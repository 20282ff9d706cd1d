#include "host_tools/touch/bodies_csv.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <iterator>
#include <string_view>

namespace tactus::host {
namespace {

constexpr std::string_view kBodiesColumns =
    "t_s,body,x_m,y_m,z_m,qw,qx,qy,qz,vx_m_per_s,vy_m_per_s,vz_m_per_s,wx_rad_per_s,wy_rad_per_s,"
    "wz_rad_per_s\n";

Eigen::Quaterniond upper_half(const Mat3& rotation) {
  Eigen::Quaterniond q(rotation);
  q.normalize();
  return q.w() < 0.0 ? Eigen::Quaterniond(-q.coeffs()) : q;
}

}  // namespace

BodiesCsv::BodiesCsv(const std::filesystem::path& path, const rendering::SceneImage& scene)
    : file_(path, kBodiesColumns), bodies_(named_bodies(scene, "--bodies")) {}

void BodiesCsv::add(double t_s, const rendering::World& world) {
  for (const NamedBody& named : bodies_) {
    const rendering::RigidBody& body = *world.body(named.object);
    const rendering::BodyMotion& motion = body.motion();
    const Vec3& p = motion.center_W;
    const Vec3& v = motion.velocity_W;
    const Vec3& w = body.angular_velocity_W();
    const Eigen::Quaterniond q = upper_half(motion.rotation_WO * named.axes_O);
    fmt::format_to(std::back_inserter(file_.buffer()),
                   "{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", t_s, named.name, p.x(), p.y(),
                   p.z(), q.w(), q.x(), q.y(), q.z(), v.x(), v.y(), v.z(), w.x(), w.y(), w.z());
  }
  file_.flush_if_full();
}

}  // namespace tactus::host
